#pragma once

#include <QLabel>
#include <QPainter>
#include <algorithm>

namespace capstan::widgets {

/// One line of text that ends in … where it is wider than the label, whose layout may make it narrow.
class ElidedLabel : public QLabel {
 public:
  using QLabel::QLabel;
  QSize minimumSizeHint() const override {
    constexpr int kLeastWidth = 80;  // [px]
    const QSize whole = sizeHint();
    return {std::min(kLeastWidth, whole.width()), whole.height()};
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(contentsRect(), Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(text(), Qt::ElideRight, contentsRect().width()));
  }
};

}  // namespace capstan::widgets
