#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>

#include "core/base/yaml.h"
#include "tests/widgets/picture.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/figures/save_figure.h"

/// A window that has been open for a day: every curve is there however far somebody scrolls back.
namespace capstan::widgets {
namespace {

constexpr double kDay = 86'400.0, kSpike = 3.0 * 3600.0 + 0.5;  ///< [s]
constexpr double kPi = 3.14159265358979323846;

/// One row a millisecond of slow sinusoids; a camera measurement every 33 ms; occluded in 2 of 60 s. In the
/// row at kSpike every value of joint 2 jumps for one sample.
class Day {
 public:
  explicit Day(JointHistory& history) : history_(history) {}

  void feed(double seconds) {
    const auto until = static_cast<std::int64_t>(std::llround(1e3 * seconds));
    for (; ms_ < until; ++ms_) append();
  }

 private:
  void append() {
    if (ms_ % 256 == 0) level_ = 0.8 + 0.3 * std::sin(2.0 * kPi * 1e-3 * static_cast<double>(ms_) / 97.0);
    tracking::Snapshot& s = snapshot_;
    s.t = 1e-3 * static_cast<double>(ms_);
    const bool spike = ms_ == std::llround(1e3 * kSpike);
    s.q_link_true = Eigen::Vector3d(level_, level_ + (spike ? 0.6 : 0.0), 0.1 * level_);
    s.q_link_kin = s.q_link_true + Eigen::Vector3d(0.02, spike ? 0.2 : -0.01, 0.002);
    s.q_link_ukf = s.q_link_true + Eigen::Vector3d(0.001, spike ? 0.1 : 0.001, 0.0001);
    s.q_link_ukf_sigma = Eigen::Vector3d(0.004, spike ? 0.5 : 0.003, 0.0006);
    s.q_link_cam = s.q_link_true + Eigen::Vector3d(0.01, spike ? 0.4 : 0.0, 0.0);
    s.gate = ms_ % 60'000 >= 58'000 ? tracking::Gate::kBothLost : tracking::Gate::kOpen;
    s.camera_updated = s.gate == tracking::Gate::kOpen && (ms_ % 33 == 0 || spike);
    s.t_cam = s.t;
    history_.append(s);
  }

  JointHistory& history_;
  std::int64_t ms_ = 0;
  double level_ = 0.8;
  tracking::Snapshot snapshot_;
};

double highest(const QCPGraph& graph) {
  double most = -INFINITY;
  for (const QCPGraphData& point : *graph.data()) most = std::fmax(most, point.value);
  return most;
}

/// Longest time without a value in [begin, end], of a line that may have gaps for its dashes.
double longestGap(const QCPGraph& graph, double begin, double end) {
  double gap = 0.0, last = begin;
  for (const QCPGraphData& point : *graph.data()) {
    if (std::isnan(point.value) || point.key < begin || point.key > end) continue;
    gap = std::max(gap, point.key - last);
    last = point.key;
  }
  return std::max(gap, end - last);
}

class JointFigureOfADay : public testing::Test {
 protected:
  JointFigureOfADay() : history_(std::make_unique<JointHistory>()), day_(*history_), figure_(*history_) {
    figure_.setTheme(Theme::dark());
    figure_.setJointNames({"shoulder", "elbow", "insertion"});
    figure_.resize(830, 740);
    figure_.show();
  }
  ~JointFigureOfADay() override { figure_.hide(); }

  /// Every line, the dots and the shade of all joints are drawn over all of [begin, end].
  void expectCurves(double begin, double end, const char* when) {
    figure_.setTimeRange(begin, end);
    figure_.refresh(true);
    QApplication::processEvents();
    for (int joint = 0; joint < 3; ++joint) {
      const JointPlot& plot = figure_.plot(joint);
      const auto where = std::string(when) + ", joint " + std::to_string(joint + 1);
      for (const Quantity quantity : {Quantity::kTrue, Quantity::kKinematic, Quantity::kUkf})
        EXPECT_LT(longestGap(*plot.graph(quantity), begin, end), 0.1 * (end - begin))
            << where << ": " << nameOf(quantity).toStdString() << " is missing";
      EXPECT_LT(longestGap(*plot.graph(Quantity::kCamera), begin, end), 2.5 + 0.1 * (end - begin))
          << where << ": camera is missing";
      ASSERT_GT(plot.band().points().size(), 2) << where;
      EXPECT_LT(plot.band().points().front().t, begin + 0.1 * (end - begin)) << where;
      EXPECT_GT(plot.shade().drawn(), 0) << where;
      EXPECT_LE(plot.graph(Quantity::kTrue)->dataCount(), 2 * figure_.width()) << where << ": too slow";
    }
  }

  std::unique_ptr<JointHistory> history_;
  Day day_;
  JointFigure figure_;
};

TEST_F(JointFigureOfADay, ScrolledBackByThirteenMinutesEveryCurveIsThere) {
  day_.feed(20.0 * 60.0);
  expectCurves(6.0 * 60.0, 7.5 * 60.0, "13 minutes back");
  test::grab(figure_, "history_13_minutes_back");
  QTemporaryDir folder;
  const std::string table = folder.filePath("back.csv").toStdString();
  saveJointTable(*history_, 6.0 * 60.0, 7.5 * 60.0, table);
  const QStringList lines = QString::fromStdString(base::readTextFile(table)).trimmed().split('\n');
  EXPECT_TRUE(lines[0].endsWith(",block [s],of block"));
  double last = 0.0;
  for (int i = 1; i < lines.size(); ++i) {
    const double t = lines[i].section(',', 0, 0).toDouble();
    ASSERT_GE(t, last) << "the order of time";
    last = t;
  }
  EXPECT_GT(lines.size(), 1000) << "the numbers of what is drawn";
  // Cameras are slower than motors: of this time every measurement is still there.
  constexpr int kCamera = 3;
  const auto seen = std::count_if(lines.begin() + 1, lines.end(), [](const QString& line) {
    return line.endsWith(",,") && !line.section(',', kCamera, kCamera).isEmpty();
  });
  long measured = 0;
  for (std::size_t i = 0; i < history_->camera().size(); ++i)
    measured += history_->camera()[i].t >= 6.0 * 60.0 && history_->camera()[i].t <= 7.5 * 60.0;
  ASSERT_GT(measured, 2000);
  EXPECT_EQ(seen, measured);
  const auto kept =
      std::count_if(lines.begin(), lines.end(), [](const QString& line) { return line.endsWith(",lowest"); });
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const QString& line) { return line.endsWith(",highest"); }),
            kept);
}

// Where the motors' rows are all there, and where they begin to be blocks, no measurement is lost either.
TEST_F(JointFigureOfADay, ATableOverTheBeginningOfDetailHoldsEveryMeasurementOnce) {
  day_.feed(20.0 * 60.0);
  const double begin = history_->detailBegin() - 20.0, end = history_->detailBegin() + 20.0;
  QTemporaryDir folder;
  const std::string table = folder.filePath("edge.csv").toStdString();
  saveJointTable(*history_, begin, end, table);
  const QStringList lines = QString::fromStdString(base::readTextFile(table)).trimmed().split('\n');
  std::vector<double> times;
  double last = 0.0;
  for (int i = 1; i < lines.size(); ++i) {
    const double t = lines[i].section(',', 0, 0).toDouble();
    ASSERT_GE(t, last) << "the order of time";
    last = t;
    if (!lines[i].section(',', 3, 3).isEmpty()) times.push_back(t);
  }
  std::vector<double> measured;
  for (std::size_t i = 0; i < history_->camera().size(); ++i)
    if (history_->camera()[i].t >= begin && history_->camera()[i].t <= end)
      measured.push_back(history_->camera()[i].t);
  ASSERT_EQ(times.size(), measured.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], measured[i], 1e-6);
}

TEST_F(JointFigureOfADay, ADayOfOneKilohertzIsThereWithItsSpikes) {
  day_.feed(kDay);
  expectCurves(0.0, kDay, "all day");
  test::grab(figure_, "history_day");
  EXPECT_EQ(figure_.plot(0).detailMark().text().toStdString(), "◂ lowest and highest of 4.1 s");
  EXPECT_FALSE(figure_.plot(0).detailMark().box().isNull());
  expectCurves(kDay - 900.0, kDay, "the last quarter of an hour");
  EXPECT_TRUE(figure_.plot(0).detailMark().text().startsWith(QString::fromUtf8("◂ lowest and highest of ")));
  EXPECT_TRUE(figure_.plot(0).axes()->rect().contains(figure_.plot(0).detailMark().box().toRect()));
  figure_.setTimeRange(kDay - 100.0, kDay);
  EXPECT_TRUE(figure_.plot(0).detailMark().text().isEmpty()) << "every sample is there";
  figure_.setTimeRange(kDay - 900.0, kDay);
  figure_.refresh(true);
  test::grab(figure_, "history_detail_begins");
  for (const double span : {120.0, 1800.0, 6.0 * 3600.0}) {
    expectCurves(kSpike - 0.5 * span, kSpike + 0.5 * span, "about the spike");
    test::grab(figure_, QStringLiteral("history_spike_%1").arg(span));
    const JointPlot& plot = figure_.plot(1);
    const double deg = 180.0 / kPi;
    for (const auto& [quantity, above] : {std::pair{Quantity::kTrue, 0.6},
                                          {Quantity::kKinematic, 0.8},
                                          {Quantity::kUkf, 0.7},
                                          {Quantity::kCamera, 1.0}})
      EXPECT_GT(highest(*plot.graph(quantity)), deg * (0.5 + above) - 1.0)
          << nameOf(quantity).toStdString() << " over " << span << " s: the spike is lost";
    double band = 0.0;
    for (const SigmaBand::Point& point : plot.band().points()) band = std::fmax(band, point.high - point.low);
    EXPECT_GT(band, deg * 2.0) << "over " << span << " s: the spike of sigma is lost";
  }
}

}  // namespace
}  // namespace capstan::widgets
