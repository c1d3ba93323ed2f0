#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/poses/pose_diagnosis.h"

namespace capstan::diagnosis {

/// Request for a diagnosis of recordings of one robot, or of one table of tip poses.
struct DiagnosisRequest {
  std::vector<std::string> files;
  std::string robot = {};         ///< nominal robot file; empty: the recordings' own, or the default robot
  EvidenceOptions evidence = {};  ///< options of reading recordings; not for tip poses
  DiagnosisOptions options = {};  ///< for tip poses, only `only` and `seed` are used
  /// Poses that observed tip poses are compared with. Empty: kinematics if the table has them, else commands.
  /// Only for tables of tip poses.
  std::optional<PoseReference> towards = {};
};

/// Result of diagnoseFiles().
struct FilesDiagnosis {
  robot::Description nominal;  ///< robot that the diagnosis started from
  std::variant<Report, PoseReport> found;

  const Report& report() const;
};
/// jsonOf() of the report.
nlohmann::json jsonOf(const FilesDiagnosis& diagnosis);

/// True if the only file is a table of tip poses. Throws base::InputError if such a table is one of several
/// files.
bool arePoseTables(const std::vector<std::string>& files);

/// diagnose(), or a replacement in a test.
using Diagnose = std::function<Report(const std::vector<Evidence>&, const robot::Description&,
                                      const DiagnosisOptions&, base::Progress*)>;

/// Reads the files and diagnoses them; window and command line both call this function. If `progress` is
/// cancelled, the report has Report::cancelled and the results so far. Throws base::InputError if
/// readEvidence(), diagnose(), readPoseEvidence() or diagnosePoses() throws it; if a recording is given
/// twice, also under two paths; and if recordings contain different robots and no robot file is chosen.
FilesDiagnosis diagnoseFiles(const DiagnosisRequest& request, base::Progress& progress,
                             const Diagnose& diagnose = diagnosis::diagnose);

}  // namespace capstan::diagnosis
