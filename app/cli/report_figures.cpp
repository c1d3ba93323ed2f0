#include "app/cli/report_figures.h"

#include "app/cli/file_drawing.h"
#include "widgets/figures/recording_history.h"
#include "widgets/figures/save_figure.h"

namespace capstan::cli {

class ReportFigures::Impl {
 public:
  widgets::RecordingHistory rows;
};

ReportFigures::ReportFigures() : impl_(std::make_unique<Impl>()) {}
ReportFigures::~ReportFigures() = default;

void ReportFigures::add(const tracking::Snapshot& snapshot) { impl_->rows.add(snapshot); }
double ReportFigures::begin() const { return impl_->rows.history().begin(); }
double ReportFigures::end() const { return impl_->rows.history().end(); }

bool ReportFigures::save(const std::array<std::string, 3>& joint_names,
                         const std::filesystem::path& folder) const {
  if (impl_->rows.history().empty()) return false;
  const FileDrawing drawing;
  std::array<QString, 3> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = QString::fromStdString(joint_names[i]);
  widgets::exportJointFigure(impl_->rows.history(), names, begin(), end(), folder / "joints");
  return true;
}

}  // namespace capstan::cli
