#include "app/cli/report_figures.h"

#include "app/cli/file_drawing.h"
#include "widgets/figures/joint_history.h"
#include "widgets/figures/save_figure.h"

namespace capstan::cli {
namespace {

constexpr double kStep = 0.005;  ///< time between rows without a camera sample [s]

}  // namespace

class ReportFigures::Impl {
 public:
  void add(const tracking::Snapshot& snapshot) {
    const bool due = snapshot.t >= next_ - 1e-9;
    if (snapshot.motor_samples == 0 || (!due && !snapshot.camera_updated && snapshot.t != last_)) return;
    if (due) next_ = snapshot.t + kStep;
    last_ = snapshot.t;
    history.append(snapshot);
  }

  widgets::JointHistory history;

 private:
  double next_ = -1e300;
  double last_ = -1e300;  ///< time of the last row, which is replaced when its reference arrives [s]
};

ReportFigures::ReportFigures() : impl_(std::make_unique<Impl>()) {}
ReportFigures::~ReportFigures() = default;

void ReportFigures::add(const tracking::Snapshot& snapshot) { impl_->add(snapshot); }
double ReportFigures::begin() const { return impl_->history.begin(); }
double ReportFigures::end() const { return impl_->history.end(); }

bool ReportFigures::save(const std::array<std::string, 3>& joint_names,
                         const std::filesystem::path& folder) const {
  if (impl_->history.empty()) return false;
  const FileDrawing drawing;
  std::array<QString, 3> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = QString::fromStdString(joint_names[i]);
  widgets::exportJointFigure(impl_->history, names, begin(), end(), folder / "joints");
  return true;
}

}  // namespace capstan::cli
