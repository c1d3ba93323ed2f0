// Views of the joint plots: hidden curves, errors, statistics, mark, box and flags.
#include <gtest/gtest.h>

#include <QtTest>
#include <cmath>

#include "tests/widgets/picture.h"
#include "tests/widgets/synthetic_motion.h"
#include "widgets/figures/joint_errors.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/figures/number_text.h"
#include "widgets/figures/range_statistics.h"

namespace capstan::widgets {
namespace {

class PlotViewsTest : public testing::Test {
 protected:
  PlotViewsTest() : figure_(history_) {
    figure_.setErrors(errors_);
    figure_.setTheme(Theme::dark());
    figure_.setJointNames({"shoulder", "elbow", "insertion"});
    figure_.resize(830, 740);
    figure_.show();
    for (int ms = 0; ms < 30'000; ms += 5) {
      tracking::Snapshot snapshot = syntheticSnapshot(ms * 1e-3);
      snapshot.reference_paired = true;
      history_.append(snapshot);
      appendErrors(errors_, snapshot);
    }
    refresh();
  }
  ~PlotViewsTest() override { figure_.hide(); }
  void refresh() {
    figure_.refresh(true);
    QApplication::processEvents();
  }
  QCPRange values(int joint = 0) { return figure_.plot(joint).axes()->axis(QCPAxis::atLeft)->range(); }
  QPoint legendEntry(Quantity quantity) {
    for (const auto& text : figure_.legend().texts())
      if (text.text == nameOf(quantity)) return text.box.center().toPoint();
    return {};
  }

  JointHistory history_{32'768}, errors_{32'768};
  JointFigure figure_;
};

TEST_F(PlotViewsTest, AClickOnTheLegendHidesACurveInAllPlots) {
  QTest::mouseClick(&figure_, Qt::LeftButton, {}, legendEntry(Quantity::kUkf));
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_FALSE(figure_.plot(joint).graph(Quantity::kUkf)->visible());
    EXPECT_FALSE(figure_.plot(joint).band().visible());
    EXPECT_TRUE(figure_.plot(joint).graph(Quantity::kCamera)->visible());
  }
  test::grab(figure_, "plots_hidden_curve");
  QTest::mouseClick(&figure_, Qt::LeftButton, {}, legendEntry(Quantity::kUkf));
  EXPECT_TRUE(figure_.plot(0).graph(Quantity::kUkf)->visible());
  QTest::mouseClick(&figure_, Qt::LeftButton, {}, legendEntry(Quantity::kTrue));
  figure_.showAll();
  EXPECT_TRUE(figure_.plot(2).graph(Quantity::kTrue)->visible());
}

TEST_F(PlotViewsTest, ErrorsAreDifferencesFromTheTruth) {
  const double span = values().size();
  QTest::keyClick(&figure_, Qt::Key_D);
  refresh();
  EXPECT_TRUE(figure_.errorsShown());
  EXPECT_LT(values().size(), 0.5 * span) << "the axis fits the errors";
  EXPECT_TRUE(figure_.plot(0).header()->title().startsWith("shoulder error q1 [deg]"));
  const double t = 20.0;
  figure_.setCursor(t);
  refresh();
  const auto at = history_.at(t)->joint[0];
  EXPECT_EQ(figure_.plot(0).header()->value(Quantity::kUkf),
            valueText(static_cast<double>(at.ukf - at.truth)));
  EXPECT_EQ(figure_.plot(0).header()->value(Quantity::kTrue), "0.00");
  test::grab(figure_, "plots_errors");
  QTest::keyClick(&figure_, Qt::Key_D);
  refresh();
  EXPECT_EQ(figure_.plot(0).header()->value(Quantity::kUkf), valueText(static_cast<double>(at.ukf)));
}

TEST_F(PlotViewsTest, WithoutAReferenceItSaysSo) {
  errors_.clear();
  tracking::Snapshot snapshot = syntheticSnapshot(30.0);
  snapshot.q_link_true.setConstant(std::nan(""));
  appendErrors(errors_, snapshot);
  EXPECT_EQ(statisticsOf(errors_, 0, Quantity::kUkf, 0.0, 31.0).count, 0U);
  figure_.showStatistics(true);
  figure_.showErrors(true);
  refresh();
  EXPECT_TRUE(figure_.plot(0).header()->title().endsWith("no reference"));
  test::grab(figure_, "plots_no_reference");
}

TEST_F(PlotViewsTest, StatisticsAreThoseOfTheRowsInView) {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < history_.rows().size(); ++i) {
    const auto& row = history_.rows()[i];
    if (row.t < 12.0 || row.t > 15.0) continue;
    const double error =
        static_cast<double>(row.joint[1].kinematic) - static_cast<double>(row.joint[1].truth);
    sum += error;
    squares += error * error;
    ++count;
  }
  const RangeStatistics found = statisticsOf(errors_, 1, Quantity::kKinematic, 12.0, 15.0);
  EXPECT_EQ(found.count, static_cast<std::size_t>(count));
  EXPECT_NEAR(found.mean, sum / count, 1e-5);
  EXPECT_NEAR(found.rms, std::sqrt(squares / count), 1e-5);
  EXPECT_NEAR(found.sigma, std::sqrt((squares - sum * sum / count) / (count - 1)), 1e-5);
  EXPECT_GT(statisticsOf(errors_, 1, Quantity::kCamera, 12.0, 15.0).count, 0U);
  const int height = figure_.plot(0).axes()->height();
  QTest::keyClick(&figure_, Qt::Key_S);
  refresh();
  EXPECT_LT(figure_.plot(0).axes()->height(), height) << "the line has room of its own";
  test::grab(figure_, "plots_statistics");
  QTest::keyClick(&figure_, Qt::Key_S);
  refresh();
  EXPECT_EQ(figure_.plot(0).axes()->height(), height);
}

TEST_F(PlotViewsTest, AMarkShowsDifferences) {
  figure_.setCursor(20.0);
  QTest::keyClick(&figure_, Qt::Key_M);
  figure_.setCursor(21.5);
  refresh();
  const double change = static_cast<double>(history_.at(21.5)->joint[0].ukf) -
                        static_cast<double>(history_.at(20.0)->joint[0].ukf);
  EXPECT_EQ(figure_.plot(0).header()->value(Quantity::kUkf), valueText(change));
  EXPECT_EQ(figure_.legend().title(), "Δt 1.500 s");
  test::grab(figure_, "plots_mark");
  QTest::keyClick(&figure_, Qt::Key_Escape);
  EXPECT_FALSE(figure_.mark());
}

TEST_F(PlotViewsTest, ShiftAndDragZoomsToTheBox) {
  const QCPAxisRect* axes = figure_.plot(1).axes();
  const QCPAxis *time = axes->axis(QCPAxis::atBottom), *value = axes->axis(QCPAxis::atLeft);
  const QPoint from = axes->rect().topLeft() + QPoint(100, 20), to = from + QPoint(150, 60);
  const QCPRange seconds(time->pixelToCoord(from.x()), time->pixelToCoord(to.x())),
      degrees(value->pixelToCoord(to.y()), value->pixelToCoord(from.y()));
  QTest::mousePress(&figure_, Qt::LeftButton, Qt::ShiftModifier, from);
  QMouseEvent move(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton, Qt::ShiftModifier);
  QApplication::sendEvent(&figure_, &move);
  QTest::mouseRelease(&figure_, Qt::LeftButton, Qt::ShiftModifier, to);
  refresh();
  EXPECT_NEAR(figure_.timeRange().lower, seconds.lower, 1e-6);
  EXPECT_NEAR(figure_.timeRange().upper, seconds.upper, 1e-6);
  EXPECT_NEAR(values(1).lower, degrees.lower, 1e-6);
  EXPECT_NEAR(values(1).upper, degrees.upper, 1e-6);
  EXPECT_FALSE(figure_.plot(1).fitting());
  EXPECT_TRUE(figure_.plot(0).fitting());
  QTest::mouseDClick(&figure_, Qt::LeftButton, {}, axes->center());
  EXPECT_TRUE(figure_.following());
  EXPECT_TRUE(figure_.plot(1).fitting());
}

TEST_F(PlotViewsTest, NotesAreFlags) {
  QImage before = figure_.grab().toImage();
  figure_.setFlags({{25.0, "needle touched"}});
  refresh();
  EXPECT_NE(figure_.grab().toImage(), before);
  test::grab(figure_, "plots_flags");
}

}  // namespace
}  // namespace capstan::widgets
