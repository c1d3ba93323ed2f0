#include "widgets/figures/figure_header.h"

namespace capstan::widgets {

namespace {

constexpr Quantity kOrder[] = {Quantity::kTrue, Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf};

}  // namespace

FigureHeader::FigureHeader(QCustomPlot* plot, Role role)
    : QCPLayoutElement(plot), role_(role), theme_(&Theme::light()) {
  setLayer("legend");
}

void FigureHeader::setTheme(const Theme& theme) { theme_ = &theme; }

void FigureHeader::setPoints(double text_points, double number_points) {
  text_points_ = text_points;
  number_points_ = number_points;
}

int FigureHeader::height() const {
  const double points = role_ == Role::kLegend ? text_points_ : std::max(text_points_, number_points_);
  return QFontMetrics(textFont(points)).height() + 4;
}

void FigureHeader::draw(QCPPainter* painter) {
  const QRectF area = QRectF(rect()).adjusted(8, 0, -11, 0);  // ends where the axes end
  const QFont title_font = textFont(text_points_, role_ == Role::kValues);
  const double title_width = std::max(area.width() * 0.2, 90.0);
  painter->setFont(title_font);
  painter->setPen(role_ == Role::kValues ? theme_->text : theme_->muted);
  painter->drawText(QRectF(area.left(), area.top(), title_width, area.height()),
                    Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine, title_);
  const double column = (area.width() - title_width) / kColumns;
  for (int i = 0; i < kColumns; ++i) {
    const QRectF box(area.left() + title_width + i * column, area.top(), column, area.height());
    if (role_ == Role::kValues) {
      painter->setFont(numberFont(number_points_));
      painter->setPen(theme_->text);
      painter->drawText(box, Qt::AlignRight | Qt::AlignVCenter | Qt::TextSingleLine, value(kOrder[i]));
      continue;
    }
    painter->setFont(textFont(text_points_));
    const QString name = value(kOrder[i]).isEmpty() ? nameOf(kOrder[i]) : value(kOrder[i]);
    const double name_width = QFontMetricsF(painter->font()).horizontalAdvance(name) + 2;
    const double sample = std::clamp(box.width() - name_width - 8, 12.0, 34.0);
    painter->setPen(theme_->text);
    painter->drawText(box, Qt::AlignRight | Qt::AlignVCenter | Qt::TextSingleLine, name);
    drawSample(painter, kOrder[i],
               QRectF(box.right() - name_width - 6 - sample, box.center().y() - 5, sample, 10));
  }
}

void FigureHeader::drawSample(QCPPainter* painter, Quantity quantity, const QRectF& box) const {
  const QColor ink = theme_->colour(quantity);
  if (quantity == Quantity::kCamera) {
    painter->setPen(Qt::NoPen);
    painter->setBrush(ink);
    for (const double share : {0.15, 0.5, 0.85})
      painter->drawEllipse(QPointF(box.left() + share * box.width(), box.center().y()), 2.5, 2.5);
    painter->setBrush(Qt::NoBrush);
    return;
  }
  if (quantity == Quantity::kUkf) {
    QColor band = ink;
    band.setAlpha(70);
    painter->fillRect(box, band);
  }
  painter->setPen(theme_->pen(quantity));
  painter->drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()));
}

}  // namespace capstan::widgets
