#include "widgets/figures/correction_experiment_figures.h"

#include <system_error>

#include "core/base/error.h"
#include "core/base/software.h"
#include "core/base/units.h"
#include "core/base/yaml.h"
#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/learning_curve_figure.h"
#include "widgets/figures/save_plot.h"

namespace capstan::widgets {
namespace {

using experiments::DebridementStudyReport;

/// One box per method, each in a group of its own: the methods are named below the axis.
class MethodsPanel {
 public:
  /// `samples`: name of the samples in the legend.
  MethodsPanel(const char* title, const char* unit, double scale, const char* samples)
      : samples_{.words = QString::fromUtf8(samples)},
        panel_{QString::fromUtf8(title), QString::fromUtf8(unit), QStringLiteral("method"), {}},
        scale_(scale) {}

  void add(std::string_view method, std::vector<double> values) {
    for (double& value : values) value *= scale_;
    panel_.groups.push_back(
        {QString::fromUtf8(method.data(), static_cast<int>(method.size())), {{samples_, boxplotOf(values)}}});
  }
  const BoxplotPanel& panel() const { return panel_; }

 private:
  SeriesKey samples_;
  BoxplotPanel panel_;
  double scale_;
};

constexpr double kMillimetres = base::toMillimetres(1.0), kDegrees = base::toDegrees(1.0);

BoxplotData boxes(const char* title, const char* quantity, std::vector<BoxplotPanel> panels) {
  BoxplotData data;
  data.title = QString::fromUtf8(title);
  data.quantity = QString::fromUtf8(quantity);
  data.panels = std::move(panels);
  data.most_columns = 1;
  return data;
}

std::unique_ptr<PanelFigure> draw(const learning::CorrectionStudyReport& report) {
  MethodsPanel distance("distance", "mm", kMillimetres, "held-out states"),
      angle("angle", "deg", kDegrees, "held-out states");
  for (std::size_t m = 1; m < learning::kCorrectionMethods; ++m) {
    const std::string number = std::to_string(m + 1);
    distance.add(number, report.distances[m]);
    angle.add(number, report.angles[m]);
  }
  BoxplotData data = boxes("Errors on clean test states", "|error|", {distance.panel(), angle.panel()});
  QStringList names;
  for (std::size_t m = 1; m < learning::kCorrectionMethods; ++m)
    names << QStringLiteral("%1 %2").arg(m + 1).arg(
        QString::fromStdString(std::string(base::nameOf(static_cast<learning::CorrectionMethod>(m)))));
  const learning::CorrectionErrors& none = report.clean.front();
  data.note = names.join(QStringLiteral("; ")) +
              QStringLiteral(". Without correction, not drawn: median %1 mm, %2 deg")
                  .arg(none.median_distance * kMillimetres, 0, 'g', 3)
                  .arg(none.median_angle * kDegrees, 0, 'g', 3);
  return std::make_unique<BoxplotFigure>(std::move(data));
}

std::unique_ptr<PanelFigure> draw(const learning::LearningCurve& curve) {
  return std::make_unique<LearningCurveFigure>(
      LearningCurveData{QStringLiteral("Error by number of training states"),
                        QStringLiteral("%1 clean states of %2 held-out trajectories")
                            .arg(curve.offset.states)
                            .arg(curve.motions_held),
                        curve});
}

std::unique_ptr<PanelFigure> drawArrival(const DebridementStudyReport& report) {
  MethodsPanel distance("distance", "mm", kMillimetres, "arrivals");
  for (std::size_t m = 0; m < report.arrival.size(); ++m)
    distance.add(base::nameOf(static_cast<learning::CorrectionMode>(m)), report.arrival[m].distances);
  return std::make_unique<BoxplotFigure>(
      boxes("Distance from the desired position on arrival", "error", {distance.panel()}));
}

std::unique_ptr<PanelFigure> drawDebridement(const DebridementStudyReport& report) {
  MethodsPanel time("time per fragment", "s", 1.0, "fragments"),
      off("grasp error", "mm", kMillimetres, "fragments");
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
  return std::make_unique<BoxplotFigure>(boxes("Debridement", "", {time.panel(), off.panel()}));
}

std::unique_ptr<PanelFigure> draw(const DebridementStudyReport& report) {
  return report.runs.front().empty() ? drawArrival(report) : drawDebridement(report);
}

const char* fileNameOf(experiments::CorrectionExperiment experiment) {
  switch (experiment) {
    case experiments::CorrectionExperiment::kErrors:
      return "errors";
    case experiments::CorrectionExperiment::kTrainingSize:
      return "training-size";
    case experiments::CorrectionExperiment::kArrival:
      return "arrival";
    case experiments::CorrectionExperiment::kDebridement:
      return "debridement";
  }
  return "";
}

}  // namespace

std::unique_ptr<PanelFigure> figureOf(const experiments::CorrectionExperimentResults& results) {
  return std::visit([](const auto& found) { return draw(found); }, results.found);
}

void writeExperiment(const experiments::CorrectionExperimentResults& results,
                     const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw base::InputError({folder.string(),
                            0,
                            {},
                            {},
                            "cannot be made: " + fault.message(),
                            "Choose a folder that takes files"});
  base::writeTextFile(folder / "comparison.md", comparisonPage(results, base::software()));
  base::writeTextFile(folder / "numbers.json", jsonOf(results).dump(2) + "\n");
  experiments::writeTables(results.tables, folder);
  exportFigure(*figureOf(results), folder / fileNameOf(results.experiment));
}

}  // namespace capstan::widgets
