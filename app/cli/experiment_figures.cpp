#include "app/cli/experiment_figures.h"

#include "app/cli/file_drawing.h"
#include "core/base/units.h"
#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/learning_curve_figure.h"
#include "widgets/figures/save_plot.h"

namespace capstan::cli {
namespace {

using experiments::DebridementStudyReport;
using widgets::BoxplotPanel;

/// One box a method, each in a group of its own: methods are named below the axis.
class MethodsPanel {
 public:
  MethodsPanel(const char* title, const char* unit, double scale)
      : panel_{QString::fromUtf8(title), QString::fromUtf8(unit), QStringLiteral("method"), {}},
        scale_(scale) {}

  void add(std::string_view method, std::vector<double> values) {
    for (double& value : values) value *= scale_;
    panel_.groups.push_back({QString::fromUtf8(method.data(), static_cast<int>(method.size())),
                             {{widgets::SeriesKey{}, widgets::boxplotOf(values)}}});
  }
  const BoxplotPanel& panel() const { return panel_; }

 private:
  BoxplotPanel panel_;
  double scale_;
};

constexpr double kMillimetres = 1e3;
const double kDegrees = base::toDegrees(1.0);

widgets::BoxplotData boxes(const char* title, const char* quantity, std::vector<BoxplotPanel> panels) {
  widgets::BoxplotData data;
  data.title = QString::fromUtf8(title);
  data.quantity = QString::fromUtf8(quantity);
  data.panels = std::move(panels);
  data.most_columns = 1;
  return data;
}

void draw(const learning::CorrectionStudyReport& report, const std::filesystem::path& folder) {
  MethodsPanel distance("distance", "mm", kMillimetres), angle("angle", "deg", kDegrees);
  for (std::size_t m = 0; m < learning::kCorrectionMethods; ++m) {
    const std::string number = std::to_string(m + 1);
    distance.add(number, report.distances[m]);
    angle.add(number, report.angles[m]);
  }
  widgets::BoxplotData data =
      boxes("Errors on clean test states", "|error|", {distance.panel(), angle.panel()});
  QStringList names;
  for (std::size_t m = 0; m < learning::kCorrectionMethods; ++m)
    names << QStringLiteral("%1 %2").arg(m + 1).arg(
        QString::fromStdString(std::string(base::nameOf(static_cast<learning::CorrectionMethod>(m)))));
  data.note = names.join(QStringLiteral("; "));
  widgets::exportFigure(widgets::BoxplotFigure(std::move(data)), folder / "errors");
}

void draw(const learning::LearningCurve& curve, const std::filesystem::path& folder) {
  const widgets::LearningCurveData data{QStringLiteral("Error by number of training states"),
                                        QStringLiteral("%1 clean states of %2 held-out trajectories")
                                            .arg(curve.offset.states)
                                            .arg(curve.motions_held),
                                        curve};
  widgets::exportFigure(widgets::LearningCurveFigure(data), folder / "training-size");
}

void drawArrival(const DebridementStudyReport& report, const std::filesystem::path& folder) {
  MethodsPanel distance("distance", "mm", kMillimetres);
  for (std::size_t m = 0; m < report.arrival.size(); ++m)
    distance.add(base::nameOf(static_cast<learning::CorrectionMode>(m)), report.arrival[m].distances);
  widgets::exportFigure(widgets::BoxplotFigure(boxes("Distance from the desired position on arrival", "error",
                                                     {distance.panel()})),
                        folder / "arrival");
}

void drawDebridement(const DebridementStudyReport& report, const std::filesystem::path& folder) {
  MethodsPanel time("time per fragment", "s", 1.0), off("grasp error", "mm", kMillimetres);
  for (std::size_t m = 0; m < report.runs.size(); ++m) {
    std::vector<double> seconds, metres;
    for (const experiments::FragmentRun& run : report.runs[m]) {
      seconds.push_back(run.time);
      metres.push_back(run.off);
    }
    const auto method = base::nameOf(static_cast<experiments::DebridementMethod>(m));
    time.add(method, std::move(seconds));
    off.add(method, std::move(metres));
  }
  widgets::exportFigure(widgets::BoxplotFigure(boxes("Debridement", "value", {time.panel(), off.panel()})),
                        folder / "debridement");
}

void draw(const DebridementStudyReport& report, const std::filesystem::path& folder) {
  if (report.runs.front().empty())
    drawArrival(report, folder);
  else
    drawDebridement(report, folder);
}

}  // namespace

void drawFigures(const experiments::CorrectionExperimentResults& results,
                 const std::filesystem::path& folder) {
  const FileDrawing drawing;
  std::visit([&](const auto& found) { draw(found, folder); }, results.found);
}

}  // namespace capstan::cli
