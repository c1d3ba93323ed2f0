#include "widgets/figures/trajectory_figure.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "widgets/figures/figure_text.h"
#include "widgets/figures/round_ticker.h"

namespace capstan::widgets {

namespace {

constexpr double kWidths = 0.5;       ///< line width in the figure, relative to the window's
constexpr double kStepsAPixel = 2.5;  ///< history steps drawn per pixel
constexpr double kDotsAPixel = 0.6;   ///< camera observations drawn per pixel
constexpr std::size_t kLeastRows = 256;
constexpr int kTwoColumns = 600;     ///< [px]
constexpr double kLeastSpan = 1e-3;  ///< least range of a value axis [deg or mm]

tracking::Snapshot snapshotOf(const TrajectorySample& sample) {
  tracking::Snapshot s;
  s.t = sample.t;
  s.t_cam = sample.t_cam.value_or(sample.t);
  s.q_link_true = sample.q_true;
  s.q_link_kin = sample.q_kin;
  s.q_link_ukf = sample.q_ukf;
  s.q_link_ukf_sigma = sample.sigma;
  s.q_link_cam = sample.q_cam;
  s.camera_updated = sample.q_cam.allFinite();
  // The row in which an occlusion begins may contain an observation from before it.
  s.gate = sample.occluded && !s.camera_updated ? tracking::Gate::kBothLost : tracking::Gate::kOpen;
  return s;
}

/// Copies with estimates − true in place of the estimates, and zero in place of the true values.
tracking::Snapshot errorsOf(const TrajectorySample& sample) {
  tracking::Snapshot s = snapshotOf(sample);
  s.q_link_true = sample.q_true - sample.q_true;
  s.q_link_kin = sample.q_kin - sample.q_true;
  s.q_link_ukf = sample.q_ukf - sample.q_true;
  s.camera_updated = false;
  return s;
}

/// RMS of `which` − true per joint, and the number of instants with a value of any joint.
std::pair<Eigen::Vector3d, std::uint64_t> rmsOf(const std::vector<TrajectorySample>& samples,
                                                Eigen::Vector3d TrajectorySample::*which) {
  Eigen::Vector3d rms = Eigen::Vector3d::Constant(std::nan(""));
  std::uint64_t most = 0;
  for (int joint = 0; joint < 3; ++joint) {
    double sum = 0.0;
    std::uint64_t n = 0;
    for (const TrajectorySample& sample : samples) {
      const double error = (sample.*which)[joint] - sample.q_true[joint];
      if (!std::isfinite(error)) continue;
      sum += error * error;
      ++n;
    }
    if (n > 0) rms[joint] = std::sqrt(sum / static_cast<double>(n));
    most = std::max(most, n);
  }
  return {rms, most};
}

TrajectoryRms rmsOf(const TrajectoryData& data) {
  if (data.rms) return *data.rms;
  TrajectoryRms rms;
  std::tie(rms.kinematic, rms.kinematic_n) = rmsOf(data.samples, &TrajectorySample::q_kin);
  std::tie(rms.ukf, rms.ukf_n) = rmsOf(data.samples, &TrajectorySample::q_ukf);
  return rms;
}

bool knowsTruth(const std::vector<TrajectorySample>& samples, int joint) {
  return std::any_of(samples.begin(), samples.end(),
                     [&](const TrajectorySample& sample) { return std::isfinite(sample.q_true[joint]); });
}

}  // namespace

TrajectoryFigure::TrajectoryFigure(TrajectoryData data, QWidget* parent)
    : PanelFigure(parent),
      data_(std::move(data)),
      rms_(rmsOf(data_)),
      history_(std::max(data_.samples.size(), kLeastRows)),
      errors_(std::max(data_.samples.size(), kLeastRows)) {
  fillHistories();
  QStringList note;
  if (!data_.note.isEmpty()) note << data_.note;
  if (const auto n = std::max(rms_.kinematic_n, rms_.ukf_n); n > 0)
    note << unbroken(tr("RMS over n %1").arg(n));
  setTitle(data_.title, note.join(QStringLiteral("; ")));
  for (int joint = 0; joint < 3; ++joint) addJoint(joint);
  fit();
}

TrajectoryFigure::~TrajectoryFigure() = default;

std::unique_ptr<Figure> TrajectoryFigure::copy() const { return std::make_unique<TrajectoryFigure>(data_); }

void TrajectoryFigure::fillHistories() {
  for (const TrajectorySample& sample : data_.samples) {
    tracking::Snapshot snapshot = snapshotOf(sample);
    snapshot.own_kinematics = data_.own_kinematics;
    history_.append(snapshot);
    errors_.append(errorsOf(sample));
  }
}

void TrajectoryFigure::addJoint(int joint) {
  const auto i = static_cast<std::size_t>(joint);
  const QString unit = tracking::kJointUnits[i];
  setGroup(joint);
  const auto add = [&](std::unique_ptr<JointPlot>& plot, const JointHistory& history,
                       std::vector<TextRow::Line> header, const QString& quantity) -> Panel& {
    plot = std::make_unique<JointPlot>(this, history, joint);
    plot->header()->setVisible(false);  // its numbers are those under a cursor
    Panel& panel = addPanel(std::move(header), tr("time [s]"), QStringLiteral("%1 [%2]").arg(quantity, unit),
                            plot->axes());
    plot->axes()->axis(QCPAxis::atBottom)->setTicker(QSharedPointer<EndTicker>::create());
    panel.empty->setVisible(data_.samples.empty());
    return panel;
  };
  add(plots_[i], history_,
      {{QStringLiteral("%1 q%2 [%3]").arg(data_.joint_names[i]).arg(joint + 1).arg(unit), true},
       {words(joint), false, true}},
      QStringLiteral("q%1").arg(joint + 1));
  if (!knowsTruth(data_.samples, joint)) return;
  add(error_plots_[i], errors_, {}, errorWord()).alone = {
      {QStringLiteral("%1 q%2, %3 [%4]").arg(data_.joint_names[i]).arg(joint + 1).arg(errorWord(), unit),
       true}};
}

/// Name of a difference from the reference.
QString TrajectoryFigure::errorWord() const { return data_.own_kinematics ? tr("difference") : tr("error"); }

QString TrajectoryFigure::words(int joint) const {
  QStringList parts;
  if (std::isfinite(rms_.kinematic[joint]))
    parts << tr("kinematic %1").arg(significantText(tracking::forPeople(rms_.kinematic[joint], joint)));
  if (std::isfinite(rms_.ukf[joint]))
    parts << tr("UKF %1").arg(significantText(tracking::forPeople(rms_.ukf[joint], joint)));
  if (parts.isEmpty()) return unbroken(tr("no reference, n %1").arg(data_.samples.size()));
  return unbroken(tr("RMS %1: %2").arg(errorWord(), parts.join(QStringLiteral(", "))));
}

std::vector<JointPlot*> TrajectoryFigure::all() const {
  std::vector<JointPlot*> plots;
  for (const auto* some : {&plots_, &error_plots_})
    for (const auto& plot : *some)
      if (plot) plots.push_back(plot.get());
  return plots;
}

/// Errors are beside the positions on a broad page, else below them.
int TrajectoryFigure::columnsFor(QSize size) const {
  const bool all =
      std::all_of(error_plots_.begin(), error_plots_.end(), [](const auto& plot) { return plot != nullptr; });
  return all && size.width() >= kTwoColumns && size.width() > size.height() ? 2 : 1;
}

void TrajectoryFigure::restyle() {
  for (JointPlot* plot : all()) plot->setTheme(theme(), true, kWidths * scale().line);
  setEntries();
}

void TrajectoryFigure::setEntries() {
  std::vector<LegendEntry> entries;
  const double widths = kWidths * scale().line;
  for (const Quantity quantity : {Quantity::kTrue, Quantity::kKinematic, Quantity::kUkf}) {
    QPen pen = theme().pen(quantity);
    pen.setWidthF(widths * pen.widthF());
    pen.setCapStyle(Qt::FlatCap);
    if (quantity == Quantity::kKinematic) pen.setDashPattern({3.6, 3.2});
    entries.push_back({quantity == Quantity::kTrue ? history_.referenceName() : nameOf(quantity),
                       [pen](QCPPainter* painter, const QRectF& box) {
                         painter->setPen(pen);
                         painter->drawLine(QPointF(box.left(), box.center().y()),
                                           QPointF(box.right(), box.center().y()));
                       }});
  }
  const auto filled = [](const QColor& colour) {
    return [colour](QCPPainter* painter, const QRectF& box) { painter->fillRect(box, colour); };
  };
  entries.push_back({QStringLiteral("±2σ"), filled(theme().band())});
  const QColor dots = theme().colour(Quantity::kCamera);
  entries.push_back({nameOf(Quantity::kCamera), [dots, widths](QCPPainter* painter, const QRectF& box) {
                       painter->setPen(Qt::NoPen);
                       painter->setBrush(dots);
                       for (const double share : {0.15, 0.5, 0.85})
                         painter->drawEllipse(QPointF(box.left() + share * box.width(), box.center().y()),
                                              2.5 * widths, 2.5 * widths);
                     }});
  if (history_.occluded().size() > 0) entries.push_back({tr("occluded"), filled(theme().occluded)});
  setLegend(std::move(entries));
}

/// As many numbers as there is room for, with the first and the last at the axis' ends.
void TrajectoryFigure::endOnTicks(JointPlot& plot) const {
  constexpr double kPitch = 1.2;    // of numbers, in their heights
  constexpr double kPadding = 4.0;  // beyond the values, so that no line is cut or lies on the axis [px]
  if (!plot.drawn()) return;
  QCPAxis* axis = plot.axes()->axis(QCPAxis::atLeft);
  const double height = QFontMetricsF(axis->tickLabelFont()).height();
  QCPRange values = *plot.drawn();
  const double missing = 0.5 * std::max(kLeastSpan - values.size(), 0.0);
  values = QCPRange(values.lower - missing, values.upper + missing);
  const auto ends = RoundTicker::endsFor(values, static_cast<int>(plot.axes()->height() / (kPitch * height)));
  const auto ticker = QSharedPointer<RoundTicker>::create();
  ticker->setFixedStep(ends.step);
  axis->setTicker(ticker);
  const double padding = kPadding * ends.range.size() / std::max(plot.axes()->height(), 1);
  axis->setRange(std::min(ends.range.lower, values.lower - padding),
                 std::max(ends.range.upper, values.upper + padding));
}

void TrajectoryFigure::laidOut() {
  const bool some = !history_.empty() && history_.end() > history_.begin();
  const double begin = history_.begin(), end = some ? history_.end() : begin + 1.0;
  for (JointPlot* plot : all()) {
    plot->axes()->axis(QCPAxis::atBottom)->setRange(begin, end);
    plot->setTickPoints(scale().tick);
    const auto most = static_cast<std::size_t>(std::max(kStepsAPixel * plot->axes()->width(), 200.0));
    plot->setMostDots(static_cast<std::size_t>(kDotsAPixel * plot->axes()->width()));
    plot->fill(begin, end, most);
    endOnTicks(*plot);
  }
}

std::string TrajectoryFigure::rmsCsv() const {
  std::string csv = "joint,unit,estimator,rms,n\n";
  for (int joint = 0; joint < 3; ++joint)
    for (const auto& [name, rms, n] : {std::tuple{"kinematic", rms_.kinematic[joint], rms_.kinematic_n},
                                       std::tuple{"ukf", rms_.ukf[joint], rms_.ukf_n}})
      csv += "q" + std::to_string(joint + 1) + "," + tracking::kJointUnits[static_cast<std::size_t>(joint)] +
             "," + name + "," + csvNumber(tracking::forPeople(rms, joint)) + "," + std::to_string(n) + "\n";
  return csv;
}

std::vector<FigureNumbers> TrajectoryFigure::numbers() const {
  std::string csv = "t [s]";
  for (int joint = 0; joint < 3; ++joint)
    for (const char* what :
         {data_.own_kinematics ? "own_kinematics" : "true", "kinematic", "camera", "ukf", "ukf_sigma"})
      csv += ",q" + std::to_string(joint + 1) + "_" + what + " [" +
             tracking::kJointUnits[static_cast<std::size_t>(joint)] + "]";
  csv += ",occluded,t_camera [s]\n";
  for (const TrajectorySample& sample : data_.samples) {
    csv += csvNumber(sample.t);
    for (int joint = 0; joint < 3; ++joint)
      for (const auto* value : {&sample.q_true, &sample.q_kin, &sample.q_cam, &sample.q_ukf, &sample.sigma})
        csv += "," + csvNumber(tracking::forPeople((*value)[joint], joint));
    csv += sample.occluded ? ",1," : ",0,";
    csv += csvNumber(sample.q_cam.allFinite() ? sample.t_cam.value_or(sample.t) : std::nan("")) + "\n";
  }
  return {{"", csv}, {"_rms", rmsCsv()}};
}

}  // namespace capstan::widgets
