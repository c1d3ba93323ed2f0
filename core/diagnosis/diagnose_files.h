#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/poses/pose_diagnosis.h"

namespace capstan::diagnosis {

/// What a person asks to be diagnosed: recordings of one robot, or one table of tip poses.
struct DiagnosisRequest {
  std::vector<std::string> files;
  std::string robot = {};         ///< nominal robot file; empty: the recordings' own, or the default robot
  EvidenceOptions evidence = {};  ///< of recordings
  DiagnosisOptions options = {};  ///< of tip poses `only` and `seed` alone
  std::optional<PoseReference> towards = {};  ///< of tip poses
};

struct FilesDiagnosis {
  robot::Description nominal;
  std::variant<Report, PoseReport> found;

  const Report& report() const;
};
/// jsonOf() of what was found.
nlohmann::json jsonOf(const FilesDiagnosis& diagnosis);

/// Are they tip poses? base::InputError: one is, and there are others beside it.
bool arePoseTables(const std::vector<std::string>& files);

/// diagnose(), or what a test has in its place.
using Diagnose = std::function<Report(const std::vector<Evidence>&, const robot::Description&,
                                      const DiagnosisOptions&, base::Progress*)>;

/// Reads the files and diagnoses them; window and command line both call this. Cancelled: Report::cancelled,
/// with what there is. base::InputError as readEvidence(), diagnose(), readPoseEvidence() and
/// diagnosePoses(); a recording is given twice, under another path too; recordings bring different robots
/// while none was chosen.
FilesDiagnosis diagnoseFiles(const DiagnosisRequest& request, base::Progress& progress,
                             const Diagnose& diagnose = diagnosis::diagnose);

}  // namespace capstan::diagnosis
