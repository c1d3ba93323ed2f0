#include "widgets/figures/trajectory_figure.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "widgets/figures/figure_text.h"

namespace capstan::widgets {

namespace {

constexpr double kWidths = 0.5;       ///< of lines on a figure, against the window's
constexpr double kStepsAPixel = 1.0;  ///< history steps drawn
constexpr double kDotsAPixel = 0.3;   ///< camera observations drawn
constexpr std::size_t kLeastRows = 256;

double inScreenUnit(double value, int joint) {
  return tracking::kJointUnits[static_cast<std::size_t>(joint)][0] == 'm' ? base::toMillimetres(value)
                                                                          : base::toDegrees(value);
}

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
  // The instant in which an occlusion begins may have an observation from before it.
  s.gate = sample.occluded && !s.camera_updated ? tracking::Gate::kBothLost : tracking::Gate::kOpen;
  return s;
}

/// RMS of `which` − true in the screen unit, and how many instants know both.
std::pair<double, std::size_t> rmsOf(const std::vector<TrajectorySample>& samples,
                                     Eigen::Vector3d TrajectorySample::*which, int joint) {
  double sum = 0.0;
  std::size_t n = 0;
  for (const TrajectorySample& sample : samples) {
    const double error = inScreenUnit((sample.*which)[joint] - sample.q_true[joint], joint);
    if (!std::isfinite(error)) continue;
    sum += error * error;
    ++n;
  }
  return {n > 0 ? std::sqrt(sum / static_cast<double>(n)) : std::nan(""), n};
}

}  // namespace

TrajectoryFigure::TrajectoryFigure(TrajectoryData data, QWidget* parent)
    : PanelFigure(parent), data_(std::move(data)), history_(std::max(data_.samples.size(), kLeastRows)) {
  fillHistory();
  setTitle(data_.title, data_.note);
  for (int i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    plots_[joint] = std::make_unique<JointPlot>(this, history_, i);
    plots_[joint]->header()->setVisible(false);  // its numbers are those under a cursor
    const QString unit = tracking::kJointUnits[joint];
    const Panel& panel =
        addPanel({{QStringLiteral("%1 q%2 [%3]").arg(data_.joint_names[joint]).arg(i + 1).arg(unit), true},
                  {words(i), false}},
                 tr("time [s]"), QStringLiteral("q%1 [%2]").arg(i + 1).arg(unit), plots_[joint]->axes());
    panel.empty->setVisible(data_.samples.empty());
  }
  fit();
}

TrajectoryFigure::~TrajectoryFigure() = default;

std::unique_ptr<Figure> TrajectoryFigure::copy() const { return std::make_unique<TrajectoryFigure>(data_); }

void TrajectoryFigure::fillHistory() {
  for (const TrajectorySample& sample : data_.samples) history_.append(snapshotOf(sample));
}

QString TrajectoryFigure::words(int joint) const {
  const QString unit = tracking::kJointUnits[static_cast<std::size_t>(joint)];
  QStringList parts;
  const auto [kin, kin_n] = rmsOf(data_.samples, &TrajectorySample::q_kin, joint);
  const auto [ukf, ukf_n] = rmsOf(data_.samples, &TrajectorySample::q_ukf, joint);
  if (kin_n > 0) parts << tr("kinematic %1 %2").arg(significantText(kin), unit);
  if (ukf_n > 0) parts << tr("UKF %1 %2").arg(significantText(ukf), unit);
  if (parts.isEmpty()) return unbroken(tr("n %1, no reference").arg(data_.samples.size()));
  return unbroken(
      tr("RMS error: %1, n %2").arg(parts.join(QStringLiteral(", "))).arg(std::max(kin_n, ukf_n)));
}

int TrajectoryFigure::columnsFor(QSize) const { return 1; }

void TrajectoryFigure::restyle() {
  for (auto& plot : plots_) plot->setTheme(theme(), true, kWidths * scale().line);
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
    entries.push_back({nameOf(quantity), [pen](QCPPainter* painter, const QRectF& box) {
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

void TrajectoryFigure::laidOut() {
  const bool some = !history_.empty() && history_.end() > history_.begin();
  const double begin = history_.begin(), end = some ? history_.end() : begin + 1.0;
  for (auto& plot : plots_) {
    plot->axes()->axis(QCPAxis::atBottom)->setRange(begin, end);
    plot->setTickPoints(scale().tick);
    const auto most = static_cast<std::size_t>(std::max(kStepsAPixel * plot->axes()->width(), 200.0));
    plot->setMostDots(static_cast<std::size_t>(kDotsAPixel * plot->axes()->width()));
    plot->fill(begin, end, most);
    plot->fitValues();
  }
}

std::vector<FigureNumbers> TrajectoryFigure::numbers() const {
  std::string csv = "t [s]";
  for (int joint = 0; joint < 3; ++joint)
    for (const char* what : {"true", "kinematic", "camera", "ukf", "ukf_sigma"})
      csv += ",q" + std::to_string(joint + 1) + "_" + what + " [" +
             tracking::kJointUnits[static_cast<std::size_t>(joint)] + "]";
  csv += ",occluded,t_camera [s]\n";
  for (const TrajectorySample& sample : data_.samples) {
    csv += csvNumber(sample.t);
    for (int joint = 0; joint < 3; ++joint)
      for (const auto* value : {&sample.q_true, &sample.q_kin, &sample.q_cam, &sample.q_ukf, &sample.sigma})
        csv += "," + csvNumber(inScreenUnit((*value)[joint], joint));
    csv += sample.occluded ? ",1," : ",0,";
    csv += csvNumber(sample.q_cam.allFinite() ? sample.t_cam.value_or(sample.t) : std::nan("")) + "\n";
  }
  return {{"", csv}};
}

}  // namespace capstan::widgets
