#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QMenu>
#include <QRubberBand>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "widgets/figures/joint_figure.h"

// Mouse and keys of the joint plots.
namespace capstan::widgets {

namespace {

constexpr double kClick = 3.0;     ///< longest move of a click [px]
constexpr double kLeastBox = 8.0;  ///< least side of a box that zooms [px]

}  // namespace

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
  dragged_ = false;
  if (!event->modifiers().testFlag(Qt::ShiftModifier)) return;
  box_ = new QRubberBand(QRubberBand::Rectangle, this);
  box_->show();
}

/// Time at the pixel x, within the history; none: beside the axes.
std::optional<double> JointFigure::timeAt(double x) const {
  const QRect area = plots_[0]->axes()->rect();
  if (x < area.left() || x > area.right()) return std::nullopt;
  return std::clamp(plots_[0]->axes()->axis(QCPAxis::atBottom)->pixelToCoord(x), limits().lower,
                    limits().upper);
}

void JointFigure::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->localPos();
  if (pointer_) pointer_ = position.x();
  dragged_ = dragged_ || (drag_from_ && (position - *drag_from_).manhattanLength() > kClick);
  if (drag_from_ && box_) {
    box_->setGeometry(QRectF(*drag_from_, position).normalized().toRect());
    return;
  }
  if (drag_from_ && dragged_) return moveTo(position);
  if (!timeAt(position.x())) return setCursor(std::nullopt);
  pointer_ = position.x();
  refresh();
}

void JointFigure::mouseReleaseEvent(QMouseEvent* event) {
  if (!drag_from_) return;
  const QRectF box = QRectF(*drag_from_, event->localPos()).normalized();
  drag_from_.reset();
  if (box_) {
    box_->deleteLater();
    box_ = nullptr;
    zoomTo(box);
  } else if (!dragged_) {
    clickLegend(event->localPos());
  }
}

/// Moves in time, so that what was under the pointer at the press is under `position`.
void JointFigure::moveTo(const QPointF& position) {
  setFollowing(false);
  const double seconds = span_ / plots_[0]->axes()->width();
  end_ = std::clamp(drag_end_ - (position.x() - drag_from_->x()) * seconds, limits().lower + 0.1 * span_,
                    limits().upper + 0.9 * span_);
  refresh();
}

/// Zooms to the time of a box, and the value axis of the plot in which it began to its values.
void JointFigure::zoomTo(const QRectF& box) {
  if (box.width() < kLeastBox) return;
  for (const auto& plot : plots_) {
    if (!plot->axes()->rect().contains(box.center().toPoint()) || box.height() < kLeastBox) continue;
    const QCPAxis* value = plot->axes()->axis(QCPAxis::atLeft);
    plot->setFitting(false);
    plot->axes()
        ->axis(QCPAxis::atLeft)
        ->setRange(value->pixelToCoord(box.bottom()), value->pixelToCoord(box.top()));
  }
  const QCPAxis* time = plots_[0]->axes()->axis(QCPAxis::atBottom);
  setTimeRange(time->pixelToCoord(box.left()), time->pixelToCoord(box.right()));
}

void JointFigure::clickLegend(const QPointF& position) {
  if (const auto quantity = legend_->entryAt(position)) setShown(*quantity, !plots_[0]->shown(*quantity));
}

void JointFigure::mouseDoubleClickEvent(QMouseEvent* event) {
  if (!legend_->entryAt(event->localPos())) return setFollowing(true);
  clickLegend(event->localPos());
}

void JointFigure::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  Q_EMIT menuAboutToShow(&menu);
  if (!menu.isEmpty()) menu.exec(event->globalPos());
}

bool JointFigure::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QCustomPlot::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  const NoteFlag* flag = flags_[0]->at(help->pos().x());
  if (flag)
    QToolTip::showText(help->globalPos(), flag->text, this);
  else
    QToolTip::hideText();
  return true;
}

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
    case Qt::Key_D:
      showErrors(!errorsShown());
      return;
    case Qt::Key_S:
      showStatistics(!statistics_on_);
      return;
    case Qt::Key_M:
      setMark(mark_ ? std::nullopt : cursor_);
      return;
    case Qt::Key_Escape:
      setMark(std::nullopt);
      return;
    default:
      QCustomPlot::keyPressEvent(event);
  }
}

}  // namespace capstan::widgets
