#include "widgets/figures/joint_figure.h"

#include <QPushButton>
#include <algorithm>
#include <utility>

#include "widgets/figures/number_text.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/range_statistics.h"

namespace capstan::widgets {

namespace {

constexpr double kCameraReach = 0.1;  ///< greatest distance in time of the camera dot at the cursor [s]
constexpr double kStepsAPixel = 0.6;  ///< history steps drawn per pixel; one step is up to two points
constexpr double kFullWidth = 900.0;  ///< paper width at which lines are as wide as on screen [px]
constexpr double kLeastValues = 1.0, kLeastErrors = 0.1;  ///< least ranges of the value axis [deg, deg, mm]
constexpr double kLiveMargin = 0.015;  ///< share of the time axis right of the newest sample

}  // namespace

JointFigure::JointFigure(const JointHistory& history, Medium medium, QWidget* parent)
    : QCustomPlot(parent), values_(history), history_(&history), medium_(medium), theme_(&Theme::light()) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  if (medium == Medium::kScreen) setMinimumSize(320, 260);
  setNoAntialiasingOnDrag(false);
  setPlottingHints(QCP::phFastPolylines | QCP::phCacheLabels);
  setAccessibleName(tr("Joint positions over time"));
  live_ = new QPushButton(this);
  setLive(false);
  live_->setToolTip(tr("Follow the newest sample again (End)"));
  live_->setFocusPolicy(Qt::NoFocus);
  live_->setCursor(Qt::PointingHandCursor);
  live_->setFont(textFont(9.0));
  live_->hide();
  connect(live_, &QPushButton::clicked, this, [this] { setFollowing(true); });
  later_.setSingleShot(true);
  connect(&later_, &QTimer::timeout, this, [this] { refresh(); });
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
    plot = std::make_unique<JointPlot>(this, *history_, i);
    addRow(plot->header());
    for (FigureHeader*& row : statistics_[static_cast<std::size_t>(i)]) {
      addRow(row = new FigureHeader(this, FigureHeader::Role::kSummary));
      row->setVisible(false);
    }
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
    flags_[static_cast<std::size_t>(i)] = new NoteFlags(plot->axes(), note_flags_);
    cursor_lines_.push_back(addLine(*plot));
    mark_lines_.push_back(addLine(*plot));
  }
  plots_[2]->axes()->axis(QCPAxis::atBottom)->setLabel(tr("time [s]"));
}

QCPItemStraightLine* JointFigure::addLine(const JointPlot& plot) {
  auto* line = new QCPItemStraightLine(this);
  for (auto* point : {line->point1, line->point2}) {
    point->setAxisRect(plot.axes());
    point->setAxes(plot.axes()->axis(QCPAxis::atBottom), plot.axes()->axis(QCPAxis::atLeft));
    point->setTypeX(QCPItemPosition::ptPlotCoords);
    point->setTypeY(QCPItemPosition::ptAxisRectRatio);
  }
  line->setClipAxisRect(plot.axes());
  line->setVisible(false);
  return line;
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
  for (auto* line : mark_lines_) line->setPen(QPen(theme.accent, 1.5));
  for (auto* flags : flags_) flags->setTheme(theme);
  for (const auto& rows : statistics_)
    for (auto* row : rows) row->setTheme(theme);
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
    plots_[i]->setTitle(!errorsShown()    ? names_[i]
                        : own_kinematics_ ? tr("%1 difference").arg(names_[i])
                                          : tr("%1 error").arg(names_[i]),
                        tracking::kJointUnits[i], unknown_ ? tr("no reference") : remarks_[i]);
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
  const HeaderLayout layout = layOutHeader(FigureHeader::kLeftMargin, w - FigureHeader::kRightMargin,
                                           std::ceil(title) + 1.0, points, values_.referenceName());
  legend_->setValue(Quantity::kTrue, values_.referenceName());
  if (note_) note_->setLayout(layout, points);
  for (auto& plot : plots_)
    if (paper) plot->setTheme(*theme_, true, std::clamp(w / kFullWidth, 0.45, 1.0));
  legend_->setLayout(layout, points);
  for (auto& plot : plots_) {
    plot->header()->setLayout(layout, points);
    plot->setTickPoints(ticks);
  }
  for (const auto& rows : statistics_)
    for (auto* row : rows) row->setLayout(layout, points);
}

/// Description of the figure, shortened to the room that there is.
QString JointFigure::noteText(const QCPRange& time, double shown) const {
  const auto within = [&](const auto& ring) {
    return ring.partitionPoint([&](const auto& item) { return item.t <= time.upper; }) -
           ring.partitionPoint([&](const auto& item) { return item.t < time.lower; });
  };
  const QString span = tr("%1 to %2 s").arg(time.lower, 0, 'f', 2).arg(time.upper, 0, 'f', 2);
  const QString at = tr(" · numbers: at %1 s").arg(shown, 0, 'f', 3);
  QString words = tr(" · %1 points drawn · %2 camera observations")
                      .arg(within(history_->rows()))
                      .arg(within(history_->camera()));
  if (!plots_[0]->detailMark().text().isEmpty())
    words = tr(" · before %1 s lowest and highest values of blocks").arg(history_->detailBegin(), 0, 'f', 2);
  const QString whole = span + words + at;
  return note_->textWidth(whole) <= width() - 2.0 * FigureHeader::kRightMargin ? whole : span + at;
}

QCPRange JointFigure::limits() const {
  return {history_->begin(), std::max(history_->end(), history_->begin() + kShortest)};
}

QCPRange JointFigure::timeRange() const { return plots_[0]->axes()->axis(QCPAxis::atBottom)->range(); }

void JointFigure::refresh(bool at_once) {
  if (viewport() != rect()) {  // no resize event comes to a figure that is not on screen
    setViewport(rect());
    fitHeaders();
  }
  if (following_)
    end_ = std::max(history_->end(), history_->begin() + span_ * (1.0 - kLiveMargin)) + kLiveMargin * span_;
  const QCPRange time(end_ - span_, end_);
  const View view = viewOf(time);
  if (!at_once && view == drawn_) return;
  if (!at_once && barelyMoved(view)) {
    if (!later_.isActive()) later_.start(kRest);
    return;
  }
  later_.stop();
  const std::size_t most = static_cast<std::size_t>(std::max(kStepsAPixel * width(), 200.0));
  for (std::size_t i = 0; i < plots_.size(); ++i) {
    plots_[i]->axes()->axis(QCPAxis::atBottom)->setRange(time);
    plots_[i]->fill(time.lower, time.upper, most);
    plots_[i]->fitValues();
    if (statistics_on_) showStatisticsOf(static_cast<int>(i), time);
  }
  const std::optional<double> cursor = pointer_ ? timeAt(*pointer_) : cursor_;
  const bool moved = std::exchange(cursor_, cursor) != cursor;
  noticeReference();
  const double shown = cursor_.value_or(following_ ? history_->end() : std::min(end_, history_->end()));
  if (note_) note_->setTitle(noteText(time, shown));
  showReadout(shown);
  if (!(time == drawn_.time)) Q_EMIT timeRangeShown(time.lower, time.upper);
  if (moved) Q_EMIT cursorMoved(cursor);
  drawn_ = viewOf(time);
  since_drawn_.start();
  replot(at_once ? rpImmediateRefresh : rpQueuedReplot);
}

void JointFigure::showStatisticsOf(int joint, const QCPRange& time) {
  const auto& [mean, rms] = statistics_[static_cast<std::size_t>(joint)];
  mean->setTitle(own_kinematics_ ? tr("mean difference in view") : tr("mean error in view"));
  rms->setTitle(own_kinematics_ ? tr("RMS difference in view") : tr("RMS error in view"));
  for (const Quantity quantity : {Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf}) {
    const RangeStatistics of = statisticsOf(*errors_, joint, quantity, time.lower, time.upper);
    mean->setValue(quantity, errorText(of.mean));
    rms->setValue(quantity, errorText(of.rms));
  }
}

void JointFigure::place(const std::vector<QCPItemStraightLine*>& lines, std::optional<double> t) {
  for (auto* line : lines) {
    line->setVisible(t.has_value());
    line->point1->setCoords(t.value_or(0.0), 0.0);
    line->point2->setCoords(t.value_or(0.0), 1.0);
  }
}

/// Writes time and values at t, or the differences from those at the mark.
void JointFigure::showReadout(double t) {
  place(cursor_lines_, cursor_);
  place(mark_lines_, mark_);
  const QString time = mark_ ? QStringLiteral("Δt %1 s").arg(t - *mark_, 0, 'f', 3)
                             : QStringLiteral("t %1 s").arg(t, 0, 'f', 3);
  legend_->setTitle(history_->empty() ? QString() : withMinus(time));
  for (auto& plot : plots_)
    if (mark_)
      plot->showDifferences(*mark_, t, kCameraReach);
    else
      plot->showValuesAt(t, kCameraReach);
}

void JointFigure::placeLiveButton() {
  const QRect area = plots_[0]->axes()->rect();
  live_->adjustSize();
  live_->move(area.right() - live_->width() - 6, area.top() + 6);
}

void JointFigure::setLive(bool live) { live_->setText(live ? tr("▸▸ live  End") : tr("▸▸ newest  End")); }

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
  if (t == cursor_ && !pointer_) return;
  pointer_.reset();
  cursor_ = t;
  refresh();
  Q_EMIT cursorMoved(t);
}

/// Says in the titles whether the errors shown are unknown.
void JointFigure::noticeReference() {
  const bool unknown = errorsShown() && !plots_[0]->drawn();
  if (unknown == unknown_ && values_.ownKinematics() == own_kinematics_) return;
  unknown_ = unknown;
  own_kinematics_ = values_.ownKinematics();
  setTitles();
}

void JointFigure::setMark(std::optional<double> t) {
  mark_ = t;
  drawAnew();
}

void JointFigure::drawAnew() {
  drawn_ = View();
  refresh();
}

void JointFigure::setSecond(const JointHistory& values, const JointHistory& errors) {
  second_values_ = &values;
  second_errors_ = &errors;
  showSecond();
}

void JointFigure::clearSecond() {
  second_values_ = second_errors_ = nullptr;
  showSecond();
}

void JointFigure::showSecond() {
  for (auto& plot : plots_) plot->setSecond(errorsShown() ? second_errors_ : second_values_);
  drawAnew();
}

void JointFigure::setErrors(const JointHistory& errors) { errors_ = &errors; }

void JointFigure::showErrors(bool on) {
  if (!errors_ || on == errorsShown()) return;
  history_ = on ? errors_ : &values_;
  for (auto& plot : plots_) {
    plot->setHistory(*history_, on ? kLeastErrors : kLeastValues);
    plot->setFitting(true);
  }
  setTitles();
  Q_EMIT errorsShownChanged(on);
  showSecond();
}

void JointFigure::showStatistics(bool on) {
  if (!errors_ || on == statistics_on_) return;
  statistics_on_ = on;
  for (const auto& rows : statistics_)
    for (auto* row : rows) row->setVisible(on);
  Q_EMIT statisticsShownChanged(on);
  drawAnew();
}

void JointFigure::setShown(Quantity quantity, bool on) {
  legend_->setMuted(quantity, !on);
  for (auto& plot : plots_) plot->setShown(quantity, on);
  drawAnew();
}

void JointFigure::showAll() {
  for (const Quantity quantity : {Quantity::kTrue, Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf})
    setShown(quantity, true);
}

void JointFigure::setFlags(std::vector<NoteFlag> flags) {
  note_flags_ = std::move(flags);
  drawAnew();
}

void JointFigure::resizeEvent(QResizeEvent* event) {
  fitHeaders();
  QCustomPlot::resizeEvent(event);
  refresh();
  placeLiveButton();
}

}  // namespace capstan::widgets
