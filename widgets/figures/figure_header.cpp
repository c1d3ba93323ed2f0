#include "widgets/figures/figure_header.h"

#include <algorithm>

#include "widgets/figures/number_text.h"

namespace capstan::widgets {

namespace {

constexpr double kMostSample = 34.0;  ///< greatest length of a legend's line [px]
constexpr std::array kColumnOrder = {Quantity::kTrue, Quantity::kKinematic, Quantity::kCamera,
                                     Quantity::kUkf};
static_assert(static_cast<int>(Quantity::kUkf) == HeaderLayout::kSigma - 1, "columns follow Quantity");

}  // namespace

FigureHeader::FigureHeader(QCustomPlot* plot, Role role)
    : QCPLayoutElement(plot), role_(role), theme_(&Theme::light()) {
  setLayer("legend");
  if (role_ != Role::kLegend) return;
  for (const Quantity quantity : kColumnOrder) setValue(quantity, nameOf(quantity));
  setSigma(kSigmaName);
}

void FigureHeader::setLayout(const HeaderLayout& layout, const HeaderPoints& points) {
  layout_ = layout;
  points_ = points;
}

QFont FigureHeader::titleFont(const HeaderPoints& points) const {
  return role_ == Role::kValues ? textFont(points.title, true) : textFont(points.legend);
}

QFont FigureHeader::columnFont() const {
  return role_ == Role::kLegend ? textFont(points_.legend) : numberFont(points_.number);
}

double FigureHeader::titleWidth(const QString& title, const HeaderPoints& points) const {
  return QFontMetricsF(titleFont(points)).horizontalAdvance(title);
}

int FigureHeader::lineHeight() const {
  return std::max(QFontMetrics(titleFont(points_)).height(), QFontMetrics(columnFont()).height()) + 3;
}

QRectF FigureHeader::titleBox() const {
  const double right = role_ == Role::kNote ? rect().right() : layout_.title_right;
  return {layout_.title_left, static_cast<double>(rect().top()), right - layout_.title_left,
          static_cast<double>(lineHeight())};
}

QRectF FigureHeader::columnBox(std::size_t column) const {
  const double top = rect().top() + (lines() - 1) * lineHeight();
  return {layout_.left[column], top, layout_.right[column] - layout_.left[column],
          static_cast<double>(lineHeight())};
}

QRectF FigureHeader::sampleBox(std::size_t column) const {
  const QRectF box = columnBox(column);
  const double right =
      box.right() - QFontMetricsF(columnFont()).horizontalAdvance(texts_[column]) - HeaderLayout::kSampleGap;
  const double width =
      std::clamp(right - box.left() - HeaderLayout::kGap, HeaderLayout::kLeastSample, kMostSample);
  return {right - width, box.center().y() - 5, width, 10};
}

std::vector<FigureHeader::Text> FigureHeader::texts() const {
  std::vector<Text> all;
  const QFontMetricsF titles(titleFont(points_));
  QRectF title = titleBox();
  const QString shown = titles.elidedText(title_, Qt::ElideRight, title.width());
  title.setWidth(titles.horizontalAdvance(shown));
  if (!shown.isEmpty()) all.push_back({shown, title});
  if (role_ == Role::kNote) return all;
  const QFontMetricsF columns(columnFont());
  for (std::size_t i = 0; i < texts_.size(); ++i) {
    if (i == HeaderLayout::kSigma && !layout_.has_sigma) continue;
    QRectF box = columnBox(i);
    box.setLeft(role_ == Role::kLegend ? sampleBox(i).left()
                                       : box.right() - columns.horizontalAdvance(texts_[i]));
    all.push_back({texts_[i], box});
  }
  return all;
}

std::optional<Quantity> FigureHeader::entryAt(const QPointF& position) const {
  for (std::size_t i = 0; i < kColumnOrder.size(); ++i)
    if (QRectF(sampleBox(i).topLeft(), columnBox(i).bottomRight()).adjusted(-4, -4, 4, 0).contains(position))
      return kColumnOrder[i];
  return std::nullopt;
}

void FigureHeader::draw(QCPPainter* painter) {
  bool title = !title_.isEmpty();
  std::size_t column = 0;
  for (const Text& text : texts()) {
    const bool muted = !title && role_ == Role::kLegend && isMuted(column++);
    QFont font = title ? titleFont(points_) : columnFont();
    font.setStrikeOut(muted);
    painter->setFont(font);
    painter->setPen(title && fault_                              ? theme_->inkOf(theme_->fault)
                    : muted || (title && role_ != Role::kValues) ? theme_->muted
                                                                 : theme_->text);
    // One pixel wider than the text, because rounding would clip it otherwise.
    painter->drawText(title ? text.box.adjusted(0, 0, 1, 0) : text.box.adjusted(-1, 0, 0, 0),
                      (title ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter | Qt::TextSingleLine,
                      text.text);
    title = false;
  }
  if (role_ != Role::kLegend) return;
  for (std::size_t i = 0; i < texts_.size(); ++i)
    if (i != HeaderLayout::kSigma || layout_.has_sigma) drawSample(painter, i, sampleBox(i));
}

void FigureHeader::drawSample(QCPPainter* painter, std::size_t column, const QRectF& box) const {
  if (isMuted(column)) return;
  if (column == HeaderLayout::kSigma) {
    painter->fillRect(box, theme_->band());
    return;
  }
  const Quantity quantity = kColumnOrder[column];
  if (quantity == Quantity::kCamera) {
    painter->setPen(Qt::NoPen);
    painter->setBrush(theme_->colour(quantity));
    for (const double share : {0.15, 0.5, 0.85})
      painter->drawEllipse(QPointF(box.left() + share * box.width(), box.center().y()), 2.5, 2.5);
    painter->setBrush(Qt::NoBrush);
    return;
  }
  QPen pen = theme_->pen(quantity);
  pen.setCapStyle(Qt::FlatCap);
  if (quantity == Quantity::kKinematic) pen.setDashPattern({2.5, 1.5});
  painter->setPen(pen);
  painter->drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()));
}

}  // namespace capstan::widgets
