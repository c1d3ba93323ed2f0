#include "widgets/panels/registration/step_bar.h"

#include <QPainter>

namespace capstan::widgets {

StepBar::StepBar(QStringList steps, QWidget* parent) : QWidget(parent), steps_(std::move(steps)) {
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void StepBar::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void StepBar::setStep(int step) {
  step_ = step;
  setAccessibleName(QString("step %1 of %2").arg(std::min<int>(step + 1, steps_.size())).arg(steps_.size()));
  update();
}

void StepBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const int cell = width() / std::max<int>(1, steps_.size());
  const QColor done = theme_.colour(Quantity::kUkf);
  for (int i = 0; i < steps_.size(); ++i) {
    const QRect area(i * cell, 0, cell, height());
    const QRect disc(area.left() + 2, area.center().y() - 11, 22, 22);
    const QColor fill = i < step_ ? done : i == step_ ? theme_.accent : theme_.raised;
    painter.setPen(QPen(i > step_ ? theme_.border : fill, 1.0));
    painter.setBrush(fill);
    painter.drawEllipse(disc);
    painter.setFont(textFont(9.5, true));
    painter.setPen(i > step_ ? theme_.muted : i < step_ ? QColor(Qt::white) : theme_.on_accent);
    painter.drawText(disc, Qt::AlignCenter, i < step_ ? QString("✓") : QString::number(i + 1));
    painter.setFont(textFont(10.5, i == step_));
    painter.setPen(i == step_ ? theme_.text : theme_.muted);
    const QRect words(disc.right() + 7, 0, area.right() - disc.right() - 12, height());
    painter.drawText(words, Qt::AlignLeft | Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(steps_[i], Qt::ElideRight, words.width()));
  }
}

}  // namespace capstan::widgets
