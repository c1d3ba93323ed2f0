#include <gtest/gtest.h>

#include <QPushButton>
#include <QSignalSpy>
#include <QtTest>
#include <cmath>

#include "tests/widgets/picture.h"
#include "tests/widgets/synthetic_motion.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/figures/number_text.h"
#include "widgets/figures/save_figure.h"

namespace capstan::widgets {
namespace {

class JointFigureTest : public testing::Test {
 protected:
  JointFigureTest() : figure_(history_) {
    figure_.setTheme(Theme::dark());
    figure_.setJointNames({"shoulder", "elbow", "insertion"});
    figure_.resize(830, 740);
    figure_.show();
    feed(0, 30'000);
  }
  ~JointFigureTest() override { figure_.hide(); }

  void feed(int from_ms, int to_ms) {
    for (int ms = from_ms; ms < to_ms; ms += 2) history_.append(syntheticSnapshot(ms * 1e-3));
    figure_.refresh(true);
    QApplication::processEvents();
  }
  /// Pixel of time t half way up a plot.
  QPoint at(double t, int joint = 0) {
    QCPAxisRect* axes = figure_.plot(joint).axes();
    return {static_cast<int>(std::lround(axes->axis(QCPAxis::atBottom)->coordToPixel(t))),
            axes->center().y()};
  }
  void wheel(const QPoint& where, int clicks) {
    QWheelEvent event(where, figure_.mapToGlobal(where), {}, {0, 120 * clicks}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&figure_, &event);
  }
  /// Moves with the left button held: QTest's own moves carry no buttons.
  void drag(const QPoint& from, const QPoint& to) {
    QTest::mousePress(&figure_, Qt::LeftButton, {}, from);
    QMouseEvent move(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(&figure_, &move);
    QTest::mouseRelease(&figure_, Qt::LeftButton, {}, to);
    QApplication::processEvents();
  }
  QPushButton* live() { return figure_.findChild<QPushButton*>(); }

  JointHistory history_{32'768}, errors_{1024};
  JointFigure figure_;
};

TEST_F(JointFigureTest, NamesTheRobotsOwnKinematicsWhereTheyAreTheReference) {
  figure_.setErrors(errors_);
  figure_.showErrors(true);
  EXPECT_EQ(figure_.legend().value(Quantity::kTrue), "true");
  EXPECT_TRUE(figure_.plot(0).header()->title().contains("shoulder error"));
  EXPECT_TRUE(jointTable(history_, 0.0, 1.0).find("q1_true") != std::string::npos);
  history_.clear();
  for (int ms = 0; ms < 3000; ms += 2) {
    tracking::Snapshot snapshot = syntheticSnapshot(ms * 1e-3);
    snapshot.own_kinematics = true;
    history_.append(snapshot);
  }
  figure_.refresh(true);
  EXPECT_EQ(figure_.legend().value(Quantity::kTrue), "own kinematics");
  EXPECT_TRUE(figure_.plot(0).header()->title().contains("shoulder difference"));
  EXPECT_TRUE(jointTable(history_, 0.0, 1.0).find("q1_own_kinematics") != std::string::npos);
  EXPECT_TRUE(jointTable(history_, 0.0, 1.0).find("q1_true") == std::string::npos);
  figure_.showErrors(false);
  test::grab(figure_, "joints_own_kinematics");
  figure_.resize(560, 600);
  test::grab(figure_, "joints_own_kinematics_narrow");
}

TEST_F(JointFigureTest, OnlyALiveSourceIsCalledLive) {
  EXPECT_TRUE(live()->text().contains("newest"));
  figure_.setLive(true);
  EXPECT_TRUE(live()->text().contains("live"));
  figure_.setLive(false);
  EXPECT_FALSE(live()->text().contains("live"));
}

TEST_F(JointFigureTest, FollowsTheNewestSample) {
  EXPECT_TRUE(figure_.following());
  EXPECT_FALSE(live()->isVisible());
  EXPECT_TRUE(figure_.timeRange().contains(29.998));
  EXPECT_NEAR(figure_.timeRange().upper - 29.998, 0.015 * 20.0, 1e-6);
  feed(30'000, 33'000);
  EXPECT_NEAR(figure_.timeRange().upper - 32.998, 0.015 * 20.0, 1e-6);
  EXPECT_NEAR(figure_.timeRange().size(), 20.0, 1e-9);
}

TEST_F(JointFigureTest, StandsStillWhileDataComeAndLeadsBackToLive) {
  QSignalSpy spy(&figure_, &JointFigure::followingChanged);
  figure_.setTimeRange(5.0, 15.0);
  const QImage before = test::grab(figure_, "figure_stands");
  feed(30'000, 33'000);
  EXPECT_DOUBLE_EQ(figure_.timeRange().lower, 5.0);
  EXPECT_DOUBLE_EQ(figure_.timeRange().upper, 15.0);
  EXPECT_EQ(before, test::grab(figure_, "figure_stands_later"));
  ASSERT_TRUE(live()->isVisible());
  const QRect area = figure_.plot(0).axes()->rect();
  EXPECT_TRUE(area.contains(live()->geometry()));
  EXPECT_LT(live()->width() * live()->height(), 0.03 * area.width() * area.height());
  EXPECT_GT(live()->x(), area.center().x());
  QTest::mouseClick(live(), Qt::LeftButton);
  EXPECT_TRUE(figure_.following());
  EXPECT_FALSE(live()->isVisible());
  EXPECT_TRUE(figure_.timeRange().contains(32.998));
  EXPECT_EQ(spy.count(), 2);
}

TEST_F(JointFigureTest, WhatStandsStillIsNotDrawnAgain) {
  int drawn = 0;
  QObject::connect(&figure_, &QCustomPlot::afterReplot, &figure_, [&drawn] { ++drawn; });
  const auto after = [&](const auto& change) {
    drawn = 0;
    change();
    figure_.refresh();
    QApplication::processEvents();
    return drawn;
  };
  figure_.setTimeRange(5.0, 15.0);
  QApplication::processEvents();
  EXPECT_EQ(after([&] { history_.append(syntheticSnapshot(30.5)); }), 0) << "new samples are not in view";
  EXPECT_GT(after([&] { figure_.setCursor(7.0); }), 0);
  EXPECT_GT(after([&] { figure_.setTheme(Theme::light()); }), 0);
  EXPECT_GT(after([&] { figure_.setTimeRange(6.0, 15.0); }), 0);
  EXPECT_GT(after([&] { figure_.setTimeRange(20.0, 40.0); }), 0);
  EXPECT_GT(after([&] { history_.append(syntheticSnapshot(31.0)); }), 0) << "in view";
  EXPECT_GT(after([&] { history_.append(syntheticSnapshot(3.0)); }), 0) << "another session";
}

TEST_F(JointFigureTest, EndAndDoubleClickFollowAgain) {
  figure_.setTimeRange(5.0, 15.0);
  QTest::keyClick(&figure_, Qt::Key_End);
  EXPECT_TRUE(figure_.following());
  figure_.setTimeRange(5.0, 15.0);
  QTest::mouseDClick(&figure_, Qt::LeftButton, {}, at(10.0));
  EXPECT_TRUE(figure_.following());
}

TEST_F(JointFigureTest, ReadOutEqualsTheHistoryUnderTheCursor) {
  figure_.setTimeRange(0.0, 20.0);
  figure_.refresh(true);
  QMouseEvent move(QEvent::MouseMove, at(3.30), Qt::NoButton, Qt::NoButton, {});
  QApplication::sendEvent(&figure_, &move);
  ASSERT_TRUE(figure_.cursorTime());
  EXPECT_NEAR(*figure_.cursorTime(), 3.30, 20.0 / 700);
  figure_.setCursor(3.301);
  const tracking::Snapshot wanted = syntheticSnapshot(3.302), seen = syntheticSnapshot(3.300);
  for (int i = 0; i < 3; ++i) {
    const double unit = i == 2 ? 1e3 : 180.0 / M_PI;
    const FigureHeader& header = *figure_.plot(i).header();
    EXPECT_NEAR(header.value(Quantity::kTrue).toDouble(), unit * wanted.q_link_true[i], 0.1) << i;
    EXPECT_NEAR(header.value(Quantity::kKinematic).toDouble(), unit * wanted.q_link_kin[i], 0.1) << i;
    EXPECT_NEAR(header.value(Quantity::kCamera).toDouble(), unit * seen.q_link_cam[i], 0.0051) << i;
    const auto row = history_.at(3.301);
    EXPECT_EQ(header.value(Quantity::kUkf),
              valueText(static_cast<double>(row->joint[static_cast<std::size_t>(i)].ukf)));
    EXPECT_EQ(header.sigma(), sigmaText(2.0 * unit * wanted.q_link_ukf_sigma[i])) << i;
  }
  EXPECT_EQ(figure_.legend().title(), "t 3.301 s");
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(&figure_, &leave);
  EXPECT_FALSE(figure_.cursorTime());
}

TEST_F(JointFigureTest, ValuesUnderAMouseAtRestMoveWithTheTimeAxis) {
  const QPoint mouse = at(15.0);
  const double from_right = figure_.timeRange().upper - 15.0;
  QMouseEvent move(QEvent::MouseMove, mouse, Qt::NoButton, Qt::NoButton, {});
  QApplication::sendEvent(&figure_, &move);
  QSignalSpy moved(&figure_, &JointFigure::cursorMoved);
  feed(30'000, 55'000);
  const double t = figure_.timeRange().upper - from_right;
  ASSERT_TRUE(figure_.cursorTime());
  EXPECT_NEAR(*figure_.cursorTime(), t, 20.0 / 700);
  EXPECT_EQ(moved.count(), 1);
  EXPECT_EQ(figure_.legend().title(), QStringLiteral("t %1 s").arg(*figure_.cursorTime(), 0, 'f', 3));
  EXPECT_NEAR(figure_.plot(0).header()->value(Quantity::kTrue).toDouble(),
              syntheticSnapshot(*figure_.cursorTime()).q_link_true[0] * 180.0 / M_PI, 0.1);
  figure_.setCursor(40.0);
  feed(55'000, 56'000);
  EXPECT_EQ(figure_.cursorTime(), 40.0) << "a time that was set stays";
}

TEST_F(JointFigureTest, CameraReadsADashWhileOccluded) {
  figure_.setTimeRange(0.0, 20.0);
  figure_.setCursor(7.0);
  EXPECT_EQ(figure_.plot(0).header()->value(Quantity::kCamera), QString::fromUtf8("—"));
  EXPECT_NE(figure_.plot(0).header()->value(Quantity::kTrue), QString::fromUtf8("—"));
}

TEST_F(JointFigureTest, WheelZoomsAboutThePointerWithinLimits) {
  figure_.setTimeRange(5.0, 15.0);
  figure_.refresh(true);
  const double share = (8.0 - 5.0) / 10.0;
  wheel(at(8.0), 2);
  EXPECT_LT(figure_.span(), 10.0);
  EXPECT_NEAR((8.0 - figure_.timeRange().lower) / figure_.span(), share, 0.01) << "what is pointed at stays";
  for (int i = 0; i < 80; ++i) wheel(at(8.0), 1);
  EXPECT_DOUBLE_EQ(figure_.span(), 0.05);
  for (int i = 0; i < 80; ++i) wheel(at(8.0), -1);
  EXPECT_NEAR(figure_.span(), 29.998 * 1.02, 1e-6);
}

TEST_F(JointFigureTest, WheelOnAValueAxisScalesThatOneUntilLive) {
  const QCPRange first = figure_.plot(0).axes()->axis(QCPAxis::atLeft)->range();
  const QCPRange second = figure_.plot(1).axes()->axis(QCPAxis::atLeft)->range();
  wheel({10, figure_.plot(0).axes()->center().y()}, 1);
  EXPECT_NEAR(figure_.plot(0).axes()->axis(QCPAxis::atLeft)->range().size(), 0.85 * first.size(), 1e-6);
  EXPECT_EQ(figure_.plot(1).axes()->axis(QCPAxis::atLeft)->range(), second);
  EXPECT_DOUBLE_EQ(figure_.span(), 20.0);
  EXPECT_FALSE(figure_.plot(0).fitting());
  figure_.setFollowing(true);
  EXPECT_TRUE(figure_.plot(0).fitting());
}

TEST_F(JointFigureTest, DragMovesInTimeByThePixelsAndStopsFollowing) {
  const QCPRange before = figure_.timeRange();
  const double seconds = before.size() / figure_.plot(0).axes()->width();
  drag(at(20.0), at(20.0) + QPoint(120, 0));
  EXPECT_FALSE(figure_.following());
  EXPECT_NEAR(before.upper - figure_.timeRange().upper, 120 * seconds, 1e-6);
  EXPECT_NEAR(figure_.span(), 20.0, 1e-9);
}

TEST_F(JointFigureTest, CoincidingCurvesAllShow) {
  for (const Theme* theme : {&Theme::dark(), &Theme::light()}) {
    JointHistory same(8192);
    JointFigure figure(same);
    figure.setTheme(*theme);
    for (int ms = 0; ms < 20'000; ms += 5) {
      tracking::Snapshot snapshot = syntheticSnapshot(ms * 1e-3);
      snapshot.q_link_kin = snapshot.q_link_ukf = snapshot.q_link_true;
      same.append(snapshot);
    }
    figure.resize(460, 740);
    figure.refresh(true);
    figure.refresh(true);
    const QImage image = test::grab(figure, "figure_coinciding_" + theme->name);
    for (int i = 0; i < 3; ++i) {
      const QRect area = figure.plot(i).axes()->rect();
      for (const Quantity quantity : {Quantity::kKinematic, Quantity::kUkf})
        EXPECT_GT(test::count(image, area, theme->colour(quantity), 60).pixels, area.width() / 3)
            << nameOf(quantity).toStdString() << " " << i;
      EXPECT_GT(test::count(image, area, theme->colour(Quantity::kTrue), 90).pixels, area.width() / 3);
    }
  }
}

TEST_F(JointFigureTest, TheWordInAShadeMeetsNoCurve) {
  figure_.setTimeRange(4.0, 12.0);
  QCPAxisRect* axes = figure_.plot(0).axes();
  const QCPRange fitted = axes->axis(QCPAxis::atLeft)->range();
  figure_.plot(0).setFitting(false);
  int above = 0, below = 0;
  for (const double shift : {-0.5, -0.25, -0.05, 0.0, 0.05, 0.25, 0.5}) {
    axes->axis(QCPAxis::atLeft)->setRange(fitted + shift * fitted.size());
    figure_.refresh(true);
    const QImage image = test::grab(figure_, QString("figure_shade_%1").arg(shift));
    for (const QRectF& label : figure_.plot(0).shade().labels()) {
      const QRect box = label.toAlignedRect();
      EXPECT_TRUE(axes->rect().contains(box)) << shift;
      for (const Quantity quantity : {Quantity::kUkf, Quantity::kKinematic, Quantity::kCamera})
        EXPECT_EQ(test::count(image, box, Theme::dark().colour(quantity), 40).pixels, 0) << shift;
      (box.center().y() < axes->center().y() ? above : below) += 1;
    }
    EXPECT_TRUE(figure_.plot(1).shade().labels().empty()) << "once is enough";
  }
  EXPECT_GT(above, 0);
  EXPECT_GT(below, 0);
}

TEST_F(JointFigureTest, LooksRightAtTheWindowsSizes) {
  for (const Theme* theme : {&Theme::dark(), &Theme::light()})
    for (const QSize size : {QSize(380, 700), QSize(460, 740), QSize(830, 1000)}) {
      figure_.setTheme(*theme);
      figure_.resize(size);
      figure_.setFollowing(size.width() != 830);
      figure_.refresh(true);
      const QImage image = test::grab(figure_, QString("figure_%1_%2").arg(theme->name).arg(size.width()));
      for (int i = 0; i < 3; ++i)
        for (const Quantity quantity : {Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf})
          EXPECT_GT(test::count(image, figure_.plot(i).axes()->rect(), theme->colour(quantity), 40).pixels,
                    60);
    }
}

}  // namespace
}  // namespace capstan::widgets
