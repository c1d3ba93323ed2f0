#include "widgets/panels/learning/learning_export.h"

#include <QDir>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "widgets/figures/save_plot.h"
#include "widgets/panels/learning/learning_figures.h"

namespace capstan::widgets {

namespace {

constexpr PaperSize kTall{180.0, 160.0};

template <class FigureKind, class Data>
std::function<std::size_t()> drawing(Data data, const std::string& base, PaperSize size = {}) {
  return [data = std::move(data), base, size] { return exportFigure(FigureKind(data), base, size).size(); };
}

std::size_t writeTable(const base::Table& table, const std::string& base) {
  base::writeTextFile(base + ".csv", base::csvOf(table));
  base::writeTextFile(base + ".md", base::markdownOf(table));
  return 2;
}

void makeFolder(const QString& folder) {
  if (!QDir().mkpath(folder))
    throw base::InputError(
        {folder.toStdString(), 0, {}, {}, "cannot be made", "Choose a folder that takes files"});
}

}  // namespace

void LearningExport::start(const LearningResults& results, int which, const learning::ConfidenceSlice* slice,
                           const QImage& clouds, const QString& folder) {
  Q_ASSERT(!busy());
  folder_ = folder;
  at_ = files_ = 0;
  const std::string base = folder.toStdString() + "/";
  steps_.push_back({tr("folder"), [folder] {
                      makeFolder(folder);
                      return std::size_t{0};
                    }});
  addTables(results, base);
  addFigures(results, which, base);
  if (slice)
    steps_.push_back(
        {tr("confidence"), drawing<ConfidenceFigure>(confidenceData(*slice), base + "confidence")});
  if (!clouds.isNull())
    steps_.push_back(
        {tr("clouds"), [clouds, path = base + "clouds.png"] {
           if (clouds.save(QString::fromStdString(path))) return std::size_t{1};
           throw base::InputError({path, 0, {}, {}, "cannot be written", "Check the folder and its rights"});
         }});
  begin();
}

void LearningExport::addTables(const LearningResults& results, const std::string& base) {
  using namespace learning;
  if (results.stages)
    steps_.push_back({tr("rejected"), [stages = results.stages, path = base + "rejected.csv"] {
                        base::writeTextFile(path, rejectedCsv(*stages));
                        return std::size_t{1};
                      }});
  if (!results.study) return;
  steps_.push_back({tr("ablation"), [study = results.study, base] {
                      return writeTable(correctionTable(study->clean, paperClean(), "Clean test states"),
                                        base + "ablation-clean") +
                             writeTable(correctionTable(study->dirty, paperDirty(), "All test states"),
                                        base + "ablation-all");
                    }});
}

void LearningExport::addFigures(const LearningResults& results, int which, const std::string& base) {
  if (results.stages)
    steps_.push_back({tr("lag"), drawing<ClockOffsetFigure>(clockOffsetData(*results.stages), base + "lag")});
  if (results.stages && which >= 0)
    steps_.push_back(
        {tr("trajectory"), drawing<PoseTraceFigure>(traceData(*results.stages, results.evaluation.get(),
                                                              static_cast<std::size_t>(which)),
                                                    base + "trajectory", kTall)});
  if (results.evaluation)
    for (const bool clean : {true, false})
      steps_.push_back(
          {tr("errors"), drawing<BoxplotFigure>(errorData(*results.evaluation, clean),
                                                base + (clean ? "errors-clean" : "errors-all"), kTall)});
  if (results.evaluation)
    steps_.push_back({tr("reliability"), drawing<ReliabilityFigure>(reliabilityData(*results.evaluation),
                                                                    base + "reliability")});
  if (results.curve)
    steps_.push_back(
        {tr("learning curve"), drawing<LearningCurveFigure>(curveData(*results.curve), base + "curve")});
}

void LearningExport::step() {
  if (at_ == steps_.size())
    return end(folder_, tr("%1 files in %2.").arg(files_).arg(QDir::toNativeSeparators(folder_)));
  Q_EMIT progressed(static_cast<double>(at_) / static_cast<double>(steps_.size()), steps_[at_].name);
  files_ += steps_[at_++].write();
}

}  // namespace capstan::widgets
