#include "widgets/figures/joint_figure.h"

#include <QPushButton>
#include <algorithm>

#include "widgets/figures/number_text.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

namespace {

constexpr double kShortest = 0.05;     ///< least time shown [s]
constexpr double kCameraReach = 0.1;   ///< greatest distance in time of the camera dot at the cursor [s]
constexpr double kStepsAPixel = 0.6;   ///< history steps drawn per pixel; one step is up to two points
constexpr double kFullWidth = 900.0;   ///< paper width at which lines are as wide as on screen [px]
constexpr double kLiveMargin = 0.015;  ///< share of the time axis right of the newest sample

}  // namespace

JointFigure::JointFigure(const JointHistory& history, Medium medium, QWidget* parent)
    : QCustomPlot(parent), history_(history), medium_(medium), theme_(&Theme::light()) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  if (medium == Medium::kScreen) setMinimumSize(320, 260);
  setNoAntialiasingOnDrag(false);
  setPlottingHints(QCP::phFastPolylines | QCP::phCacheLabels);
  setAccessibleName(tr("Joint positions over time"));
  live_ = new QPushButton(tr("▸▸ live  End"), this);
  live_->setToolTip(tr("Follow the newest sample again (End)"));
  live_->setFocusPolicy(Qt::NoFocus);
  live_->setCursor(Qt::PointingHandCursor);
  live_->setFont(textFont(9.0));
  live_->hide();
  connect(live_, &QPushButton::clicked, this, [this] { setFollowing(true); });
  layOut();
  setJointNames({tr("joint 1"), tr("joint 2"), tr("joint 3")});
  setTheme(Theme::light());
}

void JointFigure::layOut() {
  plotLayout()->clear();
  plotLayout()->setRowSpacing(0);
  const auto addRow = [this](QCPLayoutElement* row) {
    plotLayout()->addElement(plotLayout()->rowCount(), 0, row);
  };
  if (medium_ == Medium::kPaper) addRow(note_ = new FigureHeader(this, FigureHeader::Role::kNote));
  addRow(legend_ = new FigureHeader(this, FigureHeader::Role::kLegend));
  auto* left = new QCPMarginGroup(this);
  for (int i = 0; i < 3; ++i) {
    auto& plot = plots_[static_cast<std::size_t>(i)];
    plot = std::make_unique<JointPlot>(this, history_, i);
    addRow(plot->header());
    addRow(plot->axes());
    plot->axes()->setMarginGroup(QCP::msLeft, left);
    plot->axes()->setAutoMargins(QCP::msLeft | QCP::msTop | QCP::msBottom);
    plot->axes()->setMargins(QMargins(0, 0, FigureHeader::kRightMargin, 0));
    plot->axes()->setMinimumMargins(QMargins(6, 7, 0, 4));
    plot->axes()->axis(QCPAxis::atBottom)->setTickLabels(i == 2);
    if (medium_ == Medium::kPaper)
      plot->axes()
          ->axis(QCPAxis::atLeft)
          ->setLabel(
              QStringLiteral("q%1 [%2]").arg(i + 1).arg(tracking::kJointUnits[static_cast<std::size_t>(i)]));
    auto* line = new QCPItemStraightLine(this);
    for (auto* point : {line->point1, line->point2}) {
      point->setAxisRect(plot->axes());
      point->setAxes(plot->axes()->axis(QCPAxis::atBottom), plot->axes()->axis(QCPAxis::atLeft));
      point->setTypeX(QCPItemPosition::ptPlotCoords);
      point->setTypeY(QCPItemPosition::ptAxisRectRatio);
    }
    line->setClipAxisRect(plot->axes());
    line->setVisible(false);
    cursor_lines_.push_back(line);
  }
  plots_[2]->axes()->axis(QCPAxis::atBottom)->setLabel(tr("time [s]"));
}

void JointFigure::showOnly(int joint) {
  for (int i = 0; i < 3; ++i) {
    const JointPlot& one = plot(i);
    QCPAxis* time = one.axes()->axis(QCPAxis::atBottom);
    time->setTickLabels(i == joint);
    time->setLabel(i == joint ? tr("time [s]") : QString());
    if (i == joint) continue;
    for (QCPLayoutElement* row :
         {static_cast<QCPLayoutElement*>(one.header()), static_cast<QCPLayoutElement*>(one.axes())}) {
      plotLayout()->take(row);
      row->setVisible(false);
    }
  }
  plotLayout()->simplify();
}

bool JointFigure::fits() const {
  return std::all_of(plots_.begin(), plots_.end(), [](const auto& plot) {
    return !plot->axes()->visible() || plot->axes()->height() >= PanelFigure::kLeastAxesHeight;
  });
}

void JointFigure::setTheme(const Theme& theme) {
  theme_ = &theme;
  setBackground(QBrush(theme.surface));
  legend_->setTheme(theme);
  if (note_) note_->setTheme(theme);
  live_->setStyleSheet(
      QStringLiteral("QPushButton { color: %1; background: %2; border: 1px solid %3; "
                     "border-radius: 9px; padding: 1px 8px; min-height: 0; min-width: 0; }"
                     "QPushButton:hover { border-color: %4; color: %4; }")
          .arg(theme.text.name(), theme.raised.name(), theme.border.name(), theme.accent.name()));
  for (auto& plot : plots_) plot->setTheme(theme, medium_ == Medium::kPaper);
  for (auto* line : cursor_lines_) line->setPen(QPen(theme.text, 1, Qt::DotLine));
  fitHeaders();
  refresh();
}

void JointFigure::setJointNames(const std::array<QString, 3>& names) {
  names_ = names;
  setTitles();
}

void JointFigure::setRemarks(const std::array<QString, 3>& remarks) {
  remarks_ = remarks;
  setTitles();
  replot(rpQueuedReplot);
}

void JointFigure::setTitles() {
  drawn_ = View();
  for (std::size_t i = 0; i < plots_.size(); ++i)
    plots_[i]->setTitle(names_[i], tracking::kJointUnits[i], remarks_[i]);
  fitHeaders();
}

void JointFigure::fitHeaders() {
  const double w = width();
  const bool paper = medium_ == Medium::kPaper;
  const double ticks = std::clamp(w / 78.0, paper ? 6.5 : 9.5, 12.5);
  const HeaderPoints points{.title = std::clamp(w / 72.0, paper ? 7.0 : 9.5, 14.0),
                            .legend = std::clamp(w / 80.0, paper ? 6.5 : 9.0, 12.5),
                            .number = std::clamp(w / 66.0, paper ? 7.0 : 9.5, 16.0)};
  double title = legend_->titleWidth(QStringLiteral("t 00000.000 s"), points);
  for (auto& plot : plots_)
    title = std::max(title, plot->header()->titleWidth(plot->header()->title(), points));
  const HeaderLayout layout =
      layOutHeader(FigureHeader::kLeftMargin, w - FigureHeader::kRightMargin, std::ceil(title) + 1.0, points);
  if (note_) note_->setLayout(layout, points);
  for (auto& plot : plots_)
    if (paper) plot->setTheme(*theme_, true, std::clamp(w / kFullWidth, 0.45, 1.0));
  legend_->setLayout(layout, points);
  for (auto& plot : plots_) {
    plot->header()->setLayout(layout, points);
    plot->setTickPoints(ticks);
  }
}

/// Description of the figure, shortened to the room that there is.
QString JointFigure::noteText(const QCPRange& time) const {
  const auto within = [&](const auto& ring) {
    return ring.partitionPoint([&](const auto& item) { return item.t <= time.upper; }) -
           ring.partitionPoint([&](const auto& item) { return item.t < time.lower; });
  };
  const QString span = tr("%1 to %2 s").arg(time.lower, 0, 'f', 2).arg(time.upper, 0, 'f', 2);
  const QString at = tr(" · numbers: at t");
  QString words = tr(" · %1 points drawn · %2 camera observations")
                      .arg(within(history_.rows()))
                      .arg(within(history_.camera()));
  if (!plots_[0]->detailMark().text().isEmpty())
    words = tr(" · before %1 s lowest and highest values of blocks").arg(history_.detailBegin(), 0, 'f', 2);
  const QString whole = span + words + at;
  return note_->textWidth(whole) <= width() - 2.0 * FigureHeader::kRightMargin ? whole : span + at;
}

QCPRange JointFigure::limits() const {
  return {history_.begin(), std::max(history_.end(), history_.begin() + kShortest)};
}

QCPRange JointFigure::timeRange() const { return plots_[0]->axes()->axis(QCPAxis::atBottom)->range(); }

void JointFigure::refresh(bool at_once) {
  if (viewport() != rect()) {  // no resize event comes to a figure that is not on screen
    setViewport(rect());
    fitHeaders();
  }
  if (following_)
    end_ = std::max(history_.end(), history_.begin() + span_ * (1.0 - kLiveMargin)) + kLiveMargin * span_;
  const QCPRange time(end_ - span_, end_);
  if (!at_once && viewOf(time) == drawn_) return;
  const std::size_t most = static_cast<std::size_t>(std::max(kStepsAPixel * width(), 200.0));
  const double readout = cursor_.value_or(following_ ? history_.end() : std::min(end_, history_.end()));
  legend_->setTitle(history_.empty() ? QString()
                                     : withMinus(QStringLiteral("t %1 s").arg(readout, 0, 'f', 3)));
  if (note_) note_->setTitle(noteText(time));
  for (std::size_t i = 0; i < plots_.size(); ++i) {
    plots_[i]->axes()->axis(QCPAxis::atBottom)->setRange(time);
    plots_[i]->fill(time.lower, time.upper, most);
    plots_[i]->fitValues();
    plots_[i]->showValuesAt(readout, kCameraReach);
    cursor_lines_[i]->setVisible(cursor_.has_value());
    cursor_lines_[i]->point1->setCoords(readout, 0.0);
    cursor_lines_[i]->point2->setCoords(readout, 1.0);
  }
  drawn_ = viewOf(time);
  replot(at_once ? rpImmediateRefresh : rpQueuedReplot);
}

JointFigure::View JointFigure::viewOf(const QCPRange& time) const {
  View view{.time = time,
            .values = {},
            .size = size(),
            .theme = theme_,
            .cursor = cursor_,
            .begin = std::max(history_.begin(), time.lower),
            .detail = std::clamp(history_.detailBegin(), time.lower, time.upper),
            .block = history_.blockAt(std::max(history_.begin(), time.lower)),
            .revision = history_.end() <= time.upper ? history_.revision() : 0};
  for (std::size_t i = 0; i < plots_.size(); ++i)
    view.values[i] = plots_[i]->axes()->axis(QCPAxis::atLeft)->range();
  return view;
}

void JointFigure::placeLiveButton() {
  const QRect area = plots_[0]->axes()->rect();
  live_->adjustSize();
  live_->move(area.right() - live_->width() - 6, area.top() + 6);
}

void JointFigure::setFollowing(bool on) {
  if (on)
    for (auto& plot : plots_) plot->setFitting(true);
  if (on == following_) return;
  following_ = on;
  live_->setVisible(!on && medium_ == Medium::kScreen);
  placeLiveButton();
  Q_EMIT followingChanged(on);
  refresh();
}

void JointFigure::setSpan(double seconds) {
  const double longest = std::max(limits().size() * 1.02, 20.0);
  span_ = std::clamp(seconds, kShortest, longest);
  Q_EMIT spanChanged(span_);
  refresh();
}

void JointFigure::setTimeRange(double begin, double end) {
  setFollowing(false);
  end_ = end;
  setSpan(end - begin);
}

void JointFigure::setCursor(std::optional<double> t) {
  if (t == cursor_) return;
  cursor_ = t;
  refresh();
}

void JointFigure::zoomTime(double factor, double about) {
  if (following_) {
    setSpan(span_ * factor);
    return;
  }
  const double share = (end_ - about) / span_;
  const double old = span_;
  span_ = std::clamp(span_ * factor, kShortest, std::max(limits().size() * 1.02, 20.0));
  if (span_ != old) end_ = about + share * span_;
  setSpan(span_);
}

JointPlot* JointFigure::valueAxisAt(const QPointF& position) const {
  for (const auto& plot : plots_) {
    const QRect area = plot->axes()->rect();
    if (position.x() < area.left() && position.y() >= area.top() && position.y() <= area.bottom())
      return plot.get();
  }
  return nullptr;
}

void JointFigure::wheelEvent(QWheelEvent* event) {
  const double factor = std::pow(0.85, event->angleDelta().y() / 120.0);
  if (JointPlot* plot = valueAxisAt(event->position())) {
    QCPAxis* axis = plot->axes()->axis(QCPAxis::atLeft);
    plot->setFitting(false);
    axis->scaleRange(factor, axis->pixelToCoord(event->position().y()));
    refresh();
  } else {
    zoomTime(factor, plots_[0]->axes()->axis(QCPAxis::atBottom)->pixelToCoord(event->position().x()));
  }
  event->accept();
}

void JointFigure::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  drag_from_ = event->localPos();
  drag_end_ = end_;
}

void JointFigure::mouseMoveEvent(QMouseEvent* event) {
  const QCPAxis* time = plots_[0]->axes()->axis(QCPAxis::atBottom);
  if (drag_from_ && std::abs(event->localPos().x() - drag_from_->x()) > 3.0) {
    setFollowing(false);
    const double seconds = span_ / plots_[0]->axes()->width();
    end_ = std::clamp(drag_end_ - (event->localPos().x() - drag_from_->x()) * seconds,
                      limits().lower + 0.1 * span_, limits().upper + 0.9 * span_);
    refresh();
    return;
  }
  const QRect area = plots_[0]->axes()->rect();
  const double x = event->localPos().x();
  if (x < area.left() || x > area.right()) {
    setCursor(std::nullopt);
    return;
  }
  setCursor(std::clamp(time->pixelToCoord(x), limits().lower, limits().upper));
}

void JointFigure::mouseReleaseEvent(QMouseEvent*) { drag_from_.reset(); }

void JointFigure::mouseDoubleClickEvent(QMouseEvent*) { setFollowing(true); }

void JointFigure::leaveEvent(QEvent*) { setCursor(std::nullopt); }

void JointFigure::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_End:
      setFollowing(true);
      return;
    case Qt::Key_Plus:
      zoomTime(0.8, cursor_.value_or(timeRange().center()));
      return;
    case Qt::Key_Minus:
      zoomTime(1.25, cursor_.value_or(timeRange().center()));
      return;
    case Qt::Key_Left:
      setTimeRange(end_ - 1.1 * span_, end_ - 0.1 * span_);
      return;
    case Qt::Key_Right:
      setTimeRange(end_ - 0.9 * span_, end_ + 0.1 * span_);
      return;
    default:
      QCustomPlot::keyPressEvent(event);
  }
}

void JointFigure::resizeEvent(QResizeEvent* event) {
  fitHeaders();
  QCustomPlot::resizeEvent(event);
  refresh();
  placeLiveButton();
}

}  // namespace capstan::widgets
