#include "widgets/panels/analysis/figure_pair.h"

#include <QBoxLayout>
#include <algorithm>

namespace capstan::widgets {

namespace {

constexpr int kLeastWidth = 270;        ///< least width of figures side by side [px]
constexpr int kLeastPanelHeight = 115;  ///< [px]
constexpr int kHeadHeight = 70;         ///< title, note and legend of a figure [px]

/// Number of columns, as the figures choose it.
int histogramColumns(int width) { return std::max(1, width / 190); }
int boxplotColumns(const BoxplotData& data, int width) {
  std::size_t boxes = 1;
  for (const BoxplotPanel& panel : data.panels) {
    std::size_t of_group = 1;
    for (const BoxplotGroup& group : panel.groups) of_group = std::max(of_group, group.boxes.size());
    boxes = std::max(boxes, panel.groups.size() * of_group);
  }
  return std::max(1, width / (60 + 24 * static_cast<int>(boxes)));
}

int heightFor(std::size_t panels, int columns) {
  const int count = static_cast<int>(panels);
  return kHeadHeight + kLeastPanelHeight * ((count + columns - 1) / columns);
}

}  // namespace

FigurePair::FigurePair(QWidget* parent)
    : QScrollArea(parent), theme_(&Theme::dark()), sheet_(new QWidget), row_(new QHBoxLayout(sheet_)) {
  row_->setContentsMargins(0, 0, 0, 0);
  row_->setSpacing(2);
  setWidget(sheet_);
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setMinimumHeight(150);
  setAccessibleName(tr("histogram and box plot"));
}

void FigurePair::setTheme(const Theme& theme) {
  theme_ = theme.isDark() ? &Theme::dark() : &Theme::light();  // figures keep a reference
  if (histogram_) histogram_->setTheme(*theme_);
  if (boxplot_) boxplot_->setTheme(*theme_);
}

void FigurePair::clear() {
  delete histogram_;
  delete boxplot_;
  histogram_ = nullptr;
  boxplot_ = nullptr;
  fit();
}

void FigurePair::show(AnalysisFigures figures) {
  clear();
  histogram_ = new HistogramFigure(std::move(figures.histogram));
  boxplot_ = new BoxplotFigure(std::move(figures.boxplot));
  for (QWidget* figure : {static_cast<QWidget*>(histogram_), static_cast<QWidget*>(boxplot_)}) {
    figure->setAttribute(Qt::WA_TransparentForMouseEvents);  // the wheel scrolls
    row_->addWidget(figure, 1);
  }
  setTheme(*theme_);
  fit();
}

void FigurePair::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  fit();
}

void FigurePair::fit() {
  if (!histogram_) {
    sheet_->setMinimumHeight(0);
    return;
  }
  const int wide = viewport()->width();
  const bool beside = wide >= 2 * kLeastWidth;
  row_->setDirection(beside ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  const int each = beside ? wide / 2 : wide;
  const int left = heightFor(histogram_->data().panels.size(), histogramColumns(each));
  const int right = heightFor(boxplot_->data().panels.size(), boxplotColumns(boxplot_->data(), each));
  sheet_->setMinimumHeight(beside ? std::max(left, right) : left + right);
}

}  // namespace capstan::widgets
