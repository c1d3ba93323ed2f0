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

/// A figure of a report, created on demand.
struct DiagnosisFigure {
  std::string name;     ///< name of its files: letters, digits and -
  std::string channel;  ///< for example "q2 in slow.csv"
  PaperSize size;
  std::function<std::unique_ptr<Figure>()> make;
};

/// Figures CHANNEL-residual and CHANNEL-signatures of every channel. Of several recordings the one with the
/// largest reduction of the channel's mean square is drawn (without causes, the one with the largest
/// residual). The channel of the first cause comes first. The report must outlive the figures that are
/// created.
std::vector<DiagnosisFigure> figuresOf(const diagnosis::Report& report);

/// Writes a report into a folder, which is created: index.html (diagnosis_page.h), report.json
/// (core/diagnosis/report/report_json.h), robot.yaml (the extended robot) and figures as SVG, PDF and CSV.
/// Files of an earlier diagnosis in the folder are replaced; nothing is deleted. Each call draws one figure,
/// so that a window stays responsive:
///     DiagnosisExport all(report, origin, folder);
///     while (!all.drawn()) all.draw();
///     all.finish();
/// Throws base::InputError as checkExportFolder(folder, kDiagnosisMark), and for a file that cannot be
/// written.
class DiagnosisExport {
 public:
  /// Creates the folder, with an index page that says that the export is not finished.
  DiagnosisExport(diagnosis::Report report, DiagnosisOrigin origin, std::filesystem::path folder);
  DiagnosisExport(const DiagnosisExport&) = delete;  // figures refer to the report
  DiagnosisExport& operator=(const DiagnosisExport&) = delete;

  bool drawn() const { return next_ == figures_.size(); }           ///< whether every figure is drawn
  double fraction() const;                                          ///< share done, 0…1
  const std::string& name() const { return figures_[next_].name; }  ///< the next figure; not if drawn()
  /// Draws the next figure; call it on the thread of the application's windows. Throws base::InputError.
  void draw();
  /// Writes JSON, robot and page. Returns all files written, index.html last.
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

/// Runs the whole export. Cancelling `progress` ends it after the present figure.
std::vector<std::filesystem::path> exportDiagnosis(diagnosis::Report report, DiagnosisOrigin origin,
                                                   const std::filesystem::path& folder,
                                                   base::Progress* progress = nullptr);

}  // namespace capstan::widgets
