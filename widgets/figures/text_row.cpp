#include "widgets/figures/text_row.h"

#include "widgets/figures/theme.h"

namespace capstan::widgets {

namespace {

constexpr double kLineSpacing = 1.08;
constexpr int kBelow = 2;      ///< under the last line [px]
constexpr double kGap = 10.0;  ///< before a line beside another [px]

int lineHeight(const QFont& font) {
  return static_cast<int>(std::ceil(QFontMetricsF(font).height() * kLineSpacing));
}

}  // namespace

QStringList wrapText(const QString& text, const QFont& font, double width) {
  const QFontMetricsF metrics(font);
  QStringList lines;
  QString line;
  const auto take = [&](const QString& word, QChar space) {
    const QString longer = line.isEmpty() ? word : line + space + word;
    if (!line.isEmpty() && metrics.horizontalAdvance(longer) > width) {
      lines << line;
      line = word;
    } else {
      line = longer;
    }
  };
  for (const QString& word : text.split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    if (metrics.horizontalAdvance(word) <= width) {
      take(word, QLatin1Char(' '));
      continue;
    }
    for (const QString& part : word.split(QChar(0x00A0), Qt::SkipEmptyParts)) take(part, QLatin1Char(' '));
  }
  if (!line.isEmpty()) lines << line;
  return lines;
}

TextRow::TextRow(QCustomPlot* plot) : QCPLayoutElement(plot) { setLayer("legend"); }

void TextRow::setColours(const QColor& strong, const QColor& quiet) {
  strong_ = strong;
  quiet_ = quiet;
}

QFont TextRow::fontOf(const Line& line) const {
  return textFont(line.strong ? strong_points_ : points_, line.strong);
}

double TextRow::widthOf(const Line& line) const {
  return QFontMetricsF(fontOf(line)).horizontalAdvance(line.text);
}

void TextRow::fit(double strong_points, double points, double width) {
  strong_points_ = strong_points;
  points_ = points;
  wrapped_.clear();
  height_ = 0;
  if (!visible()) return;
  for (const Line& line : lines_) {
    if (line.beside && !wrapped_.empty() && widthOf(wrapped_.back()) + kGap + widthOf(line) <= width) {
      wrapped_.push_back(line);
      continue;
    }
    if (brief_ && !line.strong) continue;
    for (const QString& part : wrapText(line.text, fontOf(line), width)) {
      wrapped_.push_back({part, line.strong, false});
      height_ += lineHeight(fontOf(line));
    }
  }
  if (height_ > 0) height_ += kBelow;
}

std::vector<QRectF> TextRow::boxes() const {
  std::vector<QRectF> boxes;
  double below = rect().top(), right = rect().left();
  double top = below, height = 0.0;
  for (const Line& line : wrapped_) {
    if (!line.beside) {
      top = below;
      height = lineHeight(fontOf(line));
    }
    const double left = line.beside ? right + kGap : rect().left();
    boxes.emplace_back(left, top, widthOf(line), height);
    right = boxes.back().right();
    below = top + height;
  }
  return boxes;
}

void TextRow::draw(QCPPainter* painter) {
  const std::vector<QRectF> places = boxes();
  for (std::size_t i = 0; i < places.size(); ++i) {
    painter->setFont(fontOf(wrapped_[i]));
    painter->setPen(wrapped_[i].strong ? strong_ : quiet_);
    painter->drawText(places[i].adjusted(0.0, 0.0, 2.0, 0.0),
                      Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine | Qt::TextDontClip,
                      wrapped_[i].text);
  }
}

}  // namespace capstan::widgets
