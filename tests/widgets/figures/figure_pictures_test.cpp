#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <functional>

#include "tests/widgets/figures/figure_samples.h"
#include "tests/widgets/picture.h"
#include "widgets/figures/save_plot.h"

namespace capstan::widgets {
namespace {

struct Case {
  const char* name;
  std::function<std::unique_ptr<Figure>()> make;
  std::vector<Quantity> colours;  ///< that must be seen
};

template <class F, class Data>
std::function<std::unique_ptr<Figure>()> maker(Data (*sample)()) {
  return [sample] { return std::make_unique<F>(sample()); };
}

std::vector<Case> cases() {
  const auto trajectory = [] { return std::make_unique<TrajectoryFigure>(trajectorySample()); };
  const auto detail = [] { return std::make_unique<TrajectoryFigure>(trajectorySample(25.0)); };
  const auto boxes = [] { return std::make_unique<BoxplotFigure>(boxplotSample()); };
  return {{"histogram", maker<HistogramFigure>(histogramSample), {Quantity::kKinematic, Quantity::kUkf}},
          {"boxplot", boxes, {Quantity::kKinematic, Quantity::kUkf}},
          {"occlusion", maker<BoxplotFigure>(occlusionSample), {Quantity::kUkf}},
          {"radius", maker<ConvergenceFigure>(radiusSample), {Quantity::kUkf}},
          {"cables", maker<ConvergenceFigure>(cableSample), {Quantity::kUkf}},
          {"trajectory", trajectory, {Quantity::kKinematic, Quantity::kUkf, Quantity::kCamera}},
          {"detail", detail, {Quantity::kKinematic, Quantity::kUkf, Quantity::kCamera, Quantity::kTrue}}};
}

const PaperSize kSizes[] = {{88.0, 80.0}, {180.0, 120.0}, {88.0, 120.0}};

class FigurePictures : public testing::TestWithParam<int> {};

TEST_P(FigurePictures, ShowEverySeriesAtEverySizeOnPaper) {
  const Case it = cases()[static_cast<std::size_t>(GetParam())];
  const auto figure = it.make();
  QTemporaryDir folder;
  for (const PaperSize& size : kSizes) {
    const QString name = QStringLiteral("%1_%2x%3").arg(it.name).arg(size.width_mm).arg(size.height_mm);
    const auto base = std::filesystem::path(folder.path().toStdString()) / name.toStdString();
    for (const auto& file : exportFigure(*figure, base, size)) {
      if (file.extension() != ".png") continue;
      const QImage png(QString::fromStdString(file.string()));
      test::leave(png, QString::fromStdString(file.stem().string()));
      ASSERT_EQ(png.width(), static_cast<int>(std::lround(size.dots().width() * 300.0 / 96.0)));
      EXPECT_EQ(png.pixelColor(2, 2), QColor(Qt::white)) << "light on paper";
      for (const Quantity quantity : it.colours)
        EXPECT_GT(test::count(png, png.rect(), Theme::light().colour(quantity), 12).pixels, 100)
            << file.stem() << ": " << nameOf(quantity).toStdString();
    }
  }
}

TEST_P(FigurePictures, FollowTheThemeOnScreenAndStayLightOnPaper) {
  const Case it = cases()[static_cast<std::size_t>(GetParam())];
  const auto figure = it.make();
  for (const Theme* theme : {&Theme::dark(), &Theme::light()}) {
    figure->setTheme(*theme);
    figure->canvas().resize(900, 620);
    const QImage shown = test::grab(figure->canvas(), QStringLiteral("%1_%2").arg(it.name, theme->name));
    EXPECT_EQ(shown.pixelColor(2, 2), theme->surface);
    for (const Quantity quantity : it.colours)
      EXPECT_GT(test::count(shown, shown.rect(), theme->colour(quantity), 40).pixels, 30)
          << theme->name.toStdString() << ": " << nameOf(quantity).toStdString();
    EXPECT_GT(test::count(shown, shown.rect(), theme->text, 60).pixels, 100) << "words can be read";
  }
}

INSTANTIATE_TEST_SUITE_P(All, FigurePictures, testing::Range(0, 7), [](const auto& test) {
  return std::string(cases()[static_cast<std::size_t>(test.param)].name);
});

}  // namespace
}  // namespace capstan::widgets
