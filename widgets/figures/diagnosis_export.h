#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"
#include "widgets/figures/diagnosis_page.h"
#include "widgets/figures/export_folder.h"
#include "widgets/figures/figure.h"
#include "widgets/figures/paper_size.h"

namespace capstan::widgets {

/// A figure of a report, made when it is needed.
struct DiagnosisFigure {
  std::string name;     ///< for its files: letters, digits and -
  std::string channel;  ///< "q2 in slow.csv"
  PaperSize size;
  std::function<std::unique_ptr<Figure>()> make;
};

/// Of every channel residual and strongest signatures: CHANNEL-residual and CHANNEL-signatures, from the
/// recording in which it gains most (or, without causes, has the largest residual). The channel of the first
/// cause comes first. The report must outlive what is made.
std::vector<DiagnosisFigure> figuresOf(const diagnosis::Report& report);

/// A report as a folder (made): index.html (diagnosis_page.h), report.json (core/diagnosis/report_json.h),
/// robot.yaml (the extended robot) and figures as SVG, PDF and CSV. A former diagnosis in the folder is
/// written over, file by file; nothing is deleted. Figure by figure, so that a window stays alive beside it:
///     DiagnosisExport all(report, origin, folder);
///     while (!all.drawn()) all.draw();
///     all.finish();
/// Throws base::InputError as checkExportFolder(folder, kDiagnosisMark), and for a file that cannot be
/// written.
class DiagnosisExport {
 public:
  /// Makes the folder; nothing else is written yet but an index page that reports it.
  DiagnosisExport(diagnosis::Report report, DiagnosisOrigin origin, std::filesystem::path folder);
  DiagnosisExport(const DiagnosisExport&) = delete;  // figures refer to the report
  DiagnosisExport& operator=(const DiagnosisExport&) = delete;

  bool drawn() const { return next_ == figures_.size(); }           ///< every figure
  double fraction() const;                                          ///< 0…1
  const std::string& name() const { return figures_[next_].name; }  ///< of the next; not if drawn()
  /// The next figure, on the thread of the application's windows. Throws base::InputError.
  void draw();
  /// JSON, robot and page; all files that were written, index.html last.
  std::vector<std::filesystem::path> finish();

 private:
  const diagnosis::Report report_;
  DiagnosisOrigin origin_;
  std::filesystem::path folder_;
  std::vector<DiagnosisFigure> figures_;
  std::size_t next_ = 0;
  std::vector<DiagnosisChannel> channels_;
  std::vector<std::filesystem::path> files_;
};

/// All of it at once; a `progress` that is cancelled ends it behind the figure under way.
std::vector<std::filesystem::path> exportDiagnosis(diagnosis::Report report, DiagnosisOrigin origin,
                                                   const std::filesystem::path& folder,
                                                   base::Progress* progress = nullptr);

}  // namespace capstan::widgets
