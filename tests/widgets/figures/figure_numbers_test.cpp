#include <gtest/gtest.h>

#include <QStringList>
#include <limits>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/stats/histogram.h"
#include "core/stats/rms.h"
#include "tests/widgets/figures/figure_samples.h"
#include "widgets/figures/common_bins.h"
#include "widgets/figures/figure_text.h"
#include "widgets/figures/paper_size.h"
#include "widgets/figures/round_ticker.h"

/// The numbers beside a figure are those of the statistics, and odd data make no odd figure.
namespace capstan::widgets {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<QStringList> rowsOf(const Figure& figure, const std::string& suffix) {
  std::vector<QStringList> rows;
  for (const FigureNumbers& numbers : figure.numbers())
    if (numbers.suffix == suffix)
      for (const QString& line : QString::fromStdString(numbers.csv).split('\n', Qt::SkipEmptyParts))
        rows.push_back(line.split(','));
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

TEST(HistogramNumbers, EqualTheStatisticsOfTheSamples) {
  const HistogramFigure figure(histogramSample());
  const auto summary = rowsOf(figure, "_summary");
  ASSERT_EQ(summary.size(), 6U);
  EXPECT_EQ(summary[3][0], "elbow q2");
  EXPECT_EQ(summary[3][2], "UKF");
  const auto& values = figure.data().panels[1].series[1].values;
  EXPECT_EQ(summary[3][3].toULongLong(), values.size());
  EXPECT_EQ(summary[3][4].toDouble(), stats::mean(values));
  EXPECT_EQ(summary[3][5].toDouble(), stats::standardDeviation(values));

  std::vector<QStringList> bins;
  for (const QStringList& row : rowsOf(figure, ""))
    if (row[0] == "elbow q2" && row[2] == "UKF") bins.push_back(row);
  const auto desired =
      stats::histogram(values, bins.front()[3].toDouble(), bins.back()[4].toDouble(), bins.size());
  std::uint64_t inside = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    EXPECT_EQ(bins[i][5].toULongLong(), desired.counts[i]) << i;
    inside += desired.counts[i];
  }
  EXPECT_EQ(inside + summary[3][6].toULongLong() + summary[3][7].toULongLong(), values.size());
}

TEST(HistogramNumbers, BothSeriesHaveTheSameBins) {
  const HistogramFigure figure(histogramSample());
  for (const auto& panel : figure.results()) EXPECT_EQ(panel[0].histogram.edges, panel[1].histogram.edges);
}

TEST(BoxplotNumbers, EqualTheStatisticsAndListEveryOutlier) {
  const BoxplotFigure figure(boxplotSample());
  const auto rows = rowsOf(figure, "");
  ASSERT_EQ(rows.size(), 12U);
  const stats::Boxplot& box = figure.data().panels[0].groups[2].boxes[1].statistics;
  const QStringList& row = rows[5];
  EXPECT_EQ(row[2], "3");
  EXPECT_EQ(row[3], "UKF");
  EXPECT_EQ(row[4].toULongLong(), box.n);
  const double desired[] = {box.lower_whisker, box.first_quartile, box.median, box.third_quartile,
                            box.upper_whisker};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(row[5 + i].toDouble(), desired[i]) << i;
  EXPECT_EQ(row[10].toULongLong(), box.outliers.size());
  EXPECT_EQ(row[11].toULongLong(), BoxplotFigure::kMostOutliers);
  std::size_t all = 0;
  for (const auto& group : figure.data().panels[0].groups)
    for (const auto& one : group.boxes) all += one.statistics.outliers.size();
  EXPECT_EQ(rowsOf(figure, "_outliers").size(), all);
  EXPECT_EQ(figure.outlierWords().toStdString(), "1200 of " + std::to_string(all) + " outliers drawn");
}

TEST(BoxplotNumbers, ThinningKeepsTheExtremes) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  const auto kept = thinned(values, 10);
  ASSERT_EQ(kept.size(), 10U);
  EXPECT_EQ(kept.front(), 0.0);
  EXPECT_EQ(kept.back(), 999.0);
  EXPECT_EQ(thinned(values, 1000).size(), 1000U);
}

TEST(TrajectoryNumbers, AreInDegreesAndMillimetresWithEmptyCellsForTheUnknown) {
  const TrajectoryFigure figure(trajectorySample(30.0));
  const auto rows = rowsOf(figure, "");
  ASSERT_EQ(rows.size(), 601U);
  const TrajectorySample& s = figure.data().samples[370];
  ASSERT_TRUE(s.occluded);
  EXPECT_EQ(rows[370][0].toDouble(), s.t);
  EXPECT_EQ(rows[370][1].toDouble(), base::toDegrees(s.q_true[0]));
  EXPECT_TRUE(rows[370][3].isEmpty()) << "no camera";
  EXPECT_EQ(rows[370][14].toDouble(), base::toMillimetres(s.q_ukf[2]));
  EXPECT_EQ(rows[370][16], "1");
  EXPECT_EQ(rows[0][16], "0");
}

TEST(TrajectoryNumbers, RmsIsThatOfTheRunWhereItIsGiven) {
  TrajectoryData data = trajectorySample(30.0);
  const auto headerOf = [](const TrajectoryFigure& figure) {
    return figure.panels()[0].header->lines()[1].text;
  };
  const TrajectoryFigure of_samples(data);
  EXPECT_TRUE(headerOf(of_samples).contains(unbroken("kinematic 1.72"))) << "0.03 rad";
  EXPECT_TRUE(of_samples.caption().endsWith("RMS over n 601"));
  data.rms = {
      .kinematic = {0.05, 0.06, 0.007}, .ukf = {0.01, 0.02, 0.003}, .kinematic_n = 30'000, .ukf_n = 30'000};
  const TrajectoryFigure of_run(data);
  EXPECT_EQ(headerOf(of_run), unbroken("RMS error: kinematic 2.86, UKF 0.573"));
  EXPECT_TRUE(of_run.caption().endsWith("RMS over n 30000"));
  const auto rows = rowsOf(of_run, "_rms");
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[5], (QStringList{"q3", "mm", "ukf", "3", "30000"}));
}

TEST(TrajectoryPanels, ShowTheErrorsInTheirOwnScaleBeneathEachJoint) {
  TrajectoryFigure figure(trajectorySample(30.0));
  figure.canvas().resize(560, 640);
  figure.setTheme(Theme::light());  // fits it: no resize event comes to what is not shown
  ASSERT_EQ(figure.panels().size(), 6U);
  for (int joint = 0; joint < 3; ++joint) {
    ASSERT_NE(figure.errorPlot(joint), nullptr);
    const QCPAxisRect *above = figure.plot(joint).axes(), *below = figure.errorPlot(joint)->axes();
    EXPECT_GT(below->top(), above->bottom());
    EXPECT_NEAR(below->height(), above->height(), 3) << "none is squeezed for another's header";
    EXPECT_LT(2.0 * below->axis(QCPAxis::atLeft)->range().size(),
              above->axis(QCPAxis::atLeft)->range().size());
  }
  const auto zero = figure.errorPlot(1)->graph(Quantity::kTrue)->data();
  EXPECT_EQ(zero->at(zero->size() / 2)->value, 0.0);
  const auto error = figure.errorPlot(1)->graph(Quantity::kKinematic)->data();
  EXPECT_NEAR(error->at(error->size() / 2)->value, base::toDegrees(-0.04), 1e-4);

  TrajectoryData unknown = trajectorySample(30.0);
  for (TrajectorySample& s : unknown.samples) s.q_true.setConstant(kNaN);
  EXPECT_EQ(TrajectoryFigure(unknown).panels().size(), 3U) << "no truth, no errors";
}

TEST(TrajectoryPanels, KeepAxisLabelsClearOfNumbersAndHeaders) {
  TrajectoryFigure figure(trajectorySample(30.0));
  int with_unit = 0;
  for (const PaperSize size : {PaperSize{88.0, 100.0}, PaperSize{180.0, 120.0}, PaperSize{180.0, 240.0}}) {
    figure.canvas().resize(size.dots());
    figure.setTheme(Theme::light());  // fits it: no resize event comes to what is not shown
    for (const auto& panel : figure.panels()) {
      const QCPAxis* axis = panel.axes->axis(QCPAxis::atLeft);
      const QFontMetricsF metrics(axis->labelFont());
      EXPECT_FALSE(axis->label().isEmpty());
      EXPECT_GE(axis->labelPadding(), 4) << "beside the widest number";
      if (!axis->label().contains('[')) continue;
      ++with_unit;
      EXPECT_LE(metrics.horizontalAdvance(axis->label()), panel.axes->height()) << size.width_mm;
    }
  }
  EXPECT_GE(with_unit, 6) << "where there is room";
}

TEST(TrajectoryPanels, EndTheirAxesOnTicks) {
  TrajectoryFigure figure(trajectorySample(30.0));
  figure.canvas().resize(680, 600);
  figure.canvas().replot();
  for (const auto& panel : figure.panels()) {
    const QCPAxis *value = panel.axes->axis(QCPAxis::atLeft), *time = panel.axes->axis(QCPAxis::atBottom);
    const QVector<double> ticks = value->tickVector();
    ASSERT_GE(ticks.size(), 2);
    const double step = ticks[1] - ticks[0];
    // Values may reach beyond a tick by 0.15 of a step, and the axis beyond them by 4 pixels.
    const double beyond = 0.15 * step + 4.5 * value->range().size() / panel.axes->height();
    EXPECT_NEAR(ticks.first(), value->range().lower, beyond);
    EXPECT_NEAR(ticks.last(), value->range().upper, beyond);
    EXPECT_EQ(time->tickVector().first(), 0.0);
    EXPECT_EQ(time->tickVector().last(), 30.0);
  }
}

TEST(ConvergenceNumbers, EqualTheTraceAndItsEnd) {
  const ConvergenceFigure figure(radiusSample());
  const ConvergencePanel& panel = figure.data().panels[0];
  const auto rows = rowsOf(figure, "");
  ASSERT_EQ(rows.size(), panel.t.size());
  // The title has a comma: it is one quoted cell, split here in two.
  EXPECT_EQ(rows[10][3].toDouble(), panel.t[10]);
  EXPECT_EQ(rows[10][4].toDouble(), panel.value[10]);
  EXPECT_EQ(rows[10][5].toDouble(), panel.sigma[10]);
  const auto summary = rowsOf(figure, "_summary");
  EXPECT_EQ(summary[0][3].toDouble(), panel.value.back());
  EXPECT_EQ(summary[0][5].toDouble(), 59.0);
  EXPECT_EQ(summary[0][7].toDouble(), 41.0);
}

TEST(ConvergencePanels, SayOfAParameterThatIsNotSeenNoValue) {
  ConvergenceData data = cableSample();
  for (ConvergencePanel& panel : data.panels) panel.seen = false;
  data.panels[0].truth = 612000.0;
  data.panels[0].unit = "N";
  data.panels[1].truth.reset();
  const ConvergenceFigure figure(data);
  const auto wordsOf = [&](std::size_t i) {
    QString words = figure.panels()[i].header->lines()[1].text;
    return words.replace(QChar(0x00A0), ' ').toStdString();
  };
  EXPECT_EQ(wordsOf(0), "not observable, truth 612000 N");
  EXPECT_EQ(wordsOf(1), "not observable");
}

TEST(OddData, NothingAtAllSaysSo) {
  const HistogramFigure histogram({.title = "none", .panels = {{"a", "deg", {{{Quantity::kUkf}, {}}}}}});
  EXPECT_EQ(histogram.results()[0][0].n, 0U);
  EXPECT_TRUE(histogram.panels()[0].empty->visible());
  BoxplotPanel panel{
      .title = "a", .unit = "deg", .x_label = "trial", .groups = {{"1", {{{}, boxplotOf({})}}}}};
  EXPECT_TRUE(BoxplotFigure({.panels = {panel}}).panels()[0].empty->visible());
  EXPECT_TRUE(ConvergenceFigure({.panels = {{.title = "a", .unit = "mm"}}}).panels()[0].empty->visible());
  EXPECT_TRUE(TrajectoryFigure({}).panels()[0].empty->visible());
  for (const HistogramData& data : {HistogramData{}, HistogramData{.title = "no panels"}})
    EXPECT_TRUE(HistogramFigure(data).panels().empty());
}

TEST(OddData, OneSampleIsOneBinAndABoxWithoutHeight) {
  const HistogramFigure histogram({.panels = {{"a", "deg", {{{Quantity::kUkf}, {0.7}}}}}});
  const auto& result = histogram.results()[0][0];
  ASSERT_EQ(result.histogram.counts.size(), 1U);
  EXPECT_EQ(result.histogram.counts[0], 1U);
  EXPECT_TRUE(std::isnan(result.sigma));
  EXPECT_EQ(boxplotOf({0.7}).median, 0.7);
}

TEST(OddData, WhatIsNotFiniteIsLeftOutAndCounted) {
  const HistogramFigure histogram(
      {.panels = {{"a", "deg", {{{Quantity::kUkf}, {1.0, kNaN, 2.0, INFINITY, 3.0}}}}}});
  EXPECT_EQ(histogram.results()[0][0].n, 3U);
  EXPECT_EQ(histogram.results()[0][0].without_value, 2U);
  EXPECT_EQ(histogram.results()[0][0].mean, 2.0);
  EXPECT_EQ(boxplotOf({1.0, kNaN, 3.0}).n, 2U);
}

TEST(OddData, AFarOutlierNeitherFlattensTheHistogramNorIsHidden) {
  std::vector<double> values = noise(5000, 0.0, 1.0, 1);
  values.push_back(1e9);
  const HistogramFigure figure({.panels = {{"a", "deg", {{{Quantity::kUkf}, values}}}}});
  const auto& histogram = figure.results()[0][0].histogram;
  EXPECT_GE(histogram.overflow, 1U);
  EXPECT_LT(histogram.edges.back(), 20.0);
  EXPECT_EQ(histogram.total(), values.size());
  EXPECT_TRUE(figure.panels()[0].header->lines()[1].text.contains("beyond")) << "the header says how many";
}

TEST(CommonBins, AreAsNarrowAsTheNarrowestSampleAsks) {
  std::vector<double> wide, narrow;
  for (int i = 0; i < 1000; ++i) {
    wide.push_back(0.01 * i);           // IQR about 5
    narrow.push_back(4.0 + 0.003 * i);  // IQR 1.4985: bins of 2 · 1.4985 / 10, so 33.3 of them
  }
  const auto bins = commonBins({wide, narrow});
  ASSERT_TRUE(bins);
  EXPECT_EQ(bins->low, 0.0);
  EXPECT_DOUBLE_EQ(bins->high, 9.99);
  EXPECT_EQ(bins->count, 34U);
  EXPECT_FALSE(commonBins({}));
  EXPECT_FALSE(commonBins({std::span<const double>()}));
}

TEST(PaperSizes, AreReadAndRefused) {
  const PaperSize size = parsePaperSize("88x60.5");
  EXPECT_EQ(size.width_mm, 88.0);
  EXPECT_EQ(size.height_mm, 60.5);
  EXPECT_EQ(PaperSize({25.4, 50.8}).dots(), QSize(96, 192));
  for (const char* text :
       {"", "88", "88x", "x60", "88x60mm", "nanx60", "39x60", "88x1001", "-88x60", "1e9x1"})
    try {
      parsePaperSize(text);
      ADD_FAILURE() << text;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().value, text);
      EXPECT_EQ(error.fault().key, "--size");
    }
}

// A low axis asks for two ticks; 0 and 100 lie outside, so that steps of 50 would leave one.
TEST(RoundTicker, LeavesNoAxisWithASingleLabel) {
  RoundTicker ticker;
  ticker.setTickCount(2);
  const auto labels = [&](double lower, double upper) {
    QVector<double> ticks;
    QVector<QString> texts;
    ticker.generate({lower, upper}, QLocale::c(), 'f', 6, ticks, nullptr, &texts);
    QStringList within;
    for (int i = 0; i < ticks.size(); ++i)
      if (ticks[i] >= lower && ticks[i] <= upper) within << texts[i];
    return within.join(' ').toStdString();
  };
  EXPECT_EQ(labels(8.0, 78.0), "20 40 60");
  EXPECT_EQ(labels(55.0, 118.0), "60 80 100");
  EXPECT_EQ(labels(-0.3, 0.31), "−0.2 0.0 0.2") << "real minus signs";
  EXPECT_EQ(labels(-60.0, 60.0), "−50 0 50") << "enough: as it was";
}

TEST(RoundTicker, EndsTakeTheNarrowestRangeOfRoundSteps) {
  const auto ends = [](double lower, double upper, int most) {
    const auto found = RoundTicker::endsFor({lower, upper}, most);
    return std::tuple(found.range.lower, found.range.upper, found.step);
  };
  EXPECT_EQ(ends(5.0, 37.0, 2), std::tuple(0.0, 40.0, 20.0));
  EXPECT_EQ(ends(303.0, 359.0, 2), std::tuple(300.0, 360.0, 30.0));
  EXPECT_EQ(ends(-0.1, 3.8, 2), std::tuple(-0.1, 4.0, 2.0)) << "a little beyond the first tick";
}

TEST(RoundTicker, NamesTheEndsOfAnAxisOfData) {
  EndTicker ticker;
  ticker.setTickCount(8);
  QVector<double> ticks;
  QVector<QString> texts;
  ticker.generate({0.0, 188.26}, QLocale::c(), 'f', 6, ticks, nullptr, &texts);
  EXPECT_EQ(texts.toList().join(' ').toStdString(), "0 20 40 60 80 100 120 140 160 188");
  ticker.setTickCount(10);
  ticker.generate({15.0, 35.0}, QLocale::c(), 'f', 6, ticks, nullptr, &texts);
  EXPECT_EQ(texts.toList().join(' ').toStdString(), "15 20 25 30 35") << "a detail: even steps";
  ticker.generate({20.0, 40.0}, QLocale::c(), 'f', 6, ticks, nullptr, &texts);
  EXPECT_EQ(texts.toList().join(' ').toStdString(), "20 22 24 26 28 30 32 34 36 38 40");
}

TEST(FigureText, HasTheDigitsThatCount) {
  EXPECT_EQ(significantText(0.12345), "0.123");
  EXPECT_EQ(significantText(-12.345), QString::fromUtf8("−12.3"));
  EXPECT_EQ(significantText(-0.005), QString::fromUtf8("−0.00500")) << "a small median of a box plot";
  EXPECT_EQ(significantText(12345.6), "12346");
  EXPECT_EQ(significantText(kNaN), QString::fromUtf8("—"));
  EXPECT_EQ(uncertainText(59.0213, 0.114), QString::fromUtf8("59.02 ± 0.11"));
  EXPECT_EQ(significantText(611999.7, 4), "612000") << "as the tables have it";
  EXPECT_EQ(significantText(2.5e7, 3), "2.50e+07");
  EXPECT_EQ(uncertainText(2.5e7, 3e5), QString::fromUtf8("2.500e+07 ± 300000"));
  EXPECT_EQ(csvText("a,\"b\""), "\"a,\"\"b\"\"\"");
  EXPECT_EQ(csvNumber(kNaN), "");
}

}  // namespace
}  // namespace capstan::widgets
