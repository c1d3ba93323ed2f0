#include "widgets/panels/work/figure_sheet.h"

#include <QLabel>
#include <QVBoxLayout>

namespace capstan::widgets {

FigureSheet::FigureSheet(QWidget* parent)
    : QWidget(parent), column_(new QVBoxLayout(this)), empty_(new QLabel) {
  column_->setContentsMargins(0, 0, 0, 0);
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setWordWrap(true);
  column_->addWidget(empty_, 1);
}

void FigureSheet::setTheme(const Theme& theme) {
  theme_ = theme.isDark() ? &Theme::dark() : &Theme::light();  // figures keep a reference
  QPalette palette = empty_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  empty_->setPalette(palette);
  if (figure_) figure_->setTheme(*theme_);
}

void FigureSheet::setFigure(std::unique_ptr<PanelFigure> figure) {
  delete figure_;
  figure_ = figure.release();
  empty_->setVisible(!figure_);
  if (!figure_) return;
  figure_->setTheme(*theme_);
  column_->addWidget(figure_, 1);
}

void FigureSheet::setEmptyWords(const QString& words) { empty_->setText(words); }

}  // namespace capstan::widgets
