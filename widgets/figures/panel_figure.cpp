#include "widgets/figures/panel_figure.h"

#include <algorithm>

#include "widgets/figures/round_ticker.h"
#include "widgets/figures/tick_fit.h"

namespace capstan::widgets {

namespace {

constexpr int kMargin = 6;         ///< margin around the figure [px]
constexpr int kPanelSpacing = 10;  ///< between panels [px]
constexpr int kMostPasses = 4;     ///< of choosing numbers and widths until they agree

}  // namespace

SheetScale SheetScale::of(double width) {
  const double points = std::clamp(5.2 + width / 240.0, 6.5, 11.5);
  return {.title = points + 1.0, .text = points, .tick = points - 0.3, .line = points / 7.5};
}

PanelFigure::PanelFigure(QWidget* parent) : QCustomPlot(parent), theme_(&Theme::light()) {
  setMinimumSize(140, 120);
  setNoAntialiasingOnDrag(false);
  plotLayout()->clear();
  plotLayout()->setRowSpacing(2);
  plotLayout()->setMargins(QMargins(kMargin, kMargin, kMargin, kMargin));
  plotLayout()->setAutoMargins(QCP::msNone);
  plotLayout()->addElement(0, 0, title_ = new TextRow(this));
  plotLayout()->addElement(1, 0, legend_ = new FigureLegend(this));
  plotLayout()->addElement(2, 0, grid_ = new QCPLayoutGrid);
  grid_->setRowSpacing(3);
  grid_->setColumnSpacing(kPanelSpacing);
}

void PanelFigure::setTitle(const QString& title, const QString& note) {
  title_->setLines({{title, true}, {note, false}});
  setAccessibleName(title);
}

QString PanelFigure::caption() const {
  QStringList parts;
  for (const TextRow::Line& line : title_->lines())
    if (!line.text.isEmpty()) parts << line.text;
  return parts.join(QStringLiteral(". ")).replace(QChar(0x00A0), QLatin1Char(' '));
}

PanelFigure::Panel& PanelFigure::addPanel(std::vector<TextRow::Line> header, const QString& x_label,
                                          const QString& y_label, QCPAxisRect* axes) {
  Panel panel{new QCPLayoutGrid,
              new TextRow(this),
              axes ? axes : new QCPAxisRect(this, true),
              x_label,
              y_label,
              nullptr,
              group_ >= 0 ? group_ : static_cast<int>(panels_.size()),
              std::move(header)};
  panel.cell->setRowSpacing(1);
  panel.cell->addElement(0, 0, panel.header);
  panel.cell->addElement(1, 0, panel.axes);
  grid_->addElement(grid_->rowCount(), 0, panel.cell);  // until arrange()
  if (!axes) panel.axes->setLayer("background");
  panel.axes->setMinimumSize(30, 20);
  for (QCPAxis* axis : panel.axes->axes()) {
    axis->setLayer("axes");
    axis->grid()->setLayer("grid");
    axis->grid()->setZeroLinePen(Qt::NoPen);
    axis->setTicker(QSharedPointer<RoundTicker>::create());
    axis->setTickLengthIn(0);
    axis->setTickLengthOut(3);
    axis->setSubTickLength(0);
  }
  panel.empty = new QCPItemText(this);
  panel.empty->position->setAxisRect(panel.axes);
  panel.empty->position->setType(QCPItemPosition::ptAxisRectRatio);
  panel.empty->position->setCoords(0.5, 0.5);
  panel.empty->setText(tr("no data"));
  panel.empty->setVisible(false);
  shown_.push_back(panels_.size());
  panels_.push_back(panel);
  columns_ = 0;
  return panels_.back();
}

void PanelFigure::setTheme(const Theme& theme) {
  theme_ = &theme;
  fit();
}

void PanelFigure::setTitled(bool titled) {
  titled_ = titled;
  fit();
}

void PanelFigure::setShown(std::vector<std::size_t> panels) {
  shown_ = std::move(panels);
  columns_ = 0;
  fit();
}

void PanelFigure::setYielding(bool yielding) {
  yielding_ = yielding;
  fit();
}

bool PanelFigure::fits() const {
  const auto whole = [](const auto& row) { return row.rect().height() >= row.needed(); };
  return whole(*title_) && whole(*legend_) && std::all_of(shown_.begin(), shown_.end(), [&](std::size_t i) {
           const Panel& panel = panels_[i];
           return whole(*panel.header) && panel.axes->height() >= leastHeight(i) &&
                  panel.axes->width() >= kLeastAxesWidth;
         });
}

void PanelFigure::fit() {
  setViewport(rect());
  scale_ = SheetScale::of(width());
  setBackground(QBrush(theme_->surface));
  title_->setVisible(titled_);
  title_->setColours(theme_->text, theme_->muted);
  restyle();
  legend_->setColour(theme_->text);
  legend_->fit(scale_.text, width() - 2.0 * kMargin);
  arrange(std::clamp(columnsFor(size()), 1, std::max(1, static_cast<int>(shown_.size()))));
  for (const Panel& panel : panels_) styleAxes(panel);
  for (const Words words : {Words::kAll, Words::kNoSecondRank, Words::kNoNote, Words::kOneLabel}) {
    fitWords(words);
    if (!yielding_ || fits()) break;
  }
  hideOthers();
  replot(rpQueuedReplot);
}

void PanelFigure::fitWords(Words words) {
  const double inner = width() - 2.0 * kMargin, wide = (inner - (columns_ - 1) * kPanelSpacing) / columns_;
  chooseHeaders();
  title_->setBrief(words >= Words::kNoNote);
  title_->fit(scale_.title, scale_.text, inner);
  for (const Panel& panel : panels_) {
    panel.header->setBrief(words >= Words::kNoSecondRank);
    panel.header->setColours(theme_->text, theme_->muted);
    panel.header->fit(scale_.text, scale_.tick, wide);
  }
  fitLabels(words >= Words::kOneLabel);
  // What laidOut() chooses depends on the width of the axes, which the numbers of fitTicks() change.
  std::vector<QRect> before;
  for (int pass = 0; pass < kMostPasses && before != axesRects(); ++pass) {
    before = axesRects();
    laidOut();
    fitTicks();
  }
}

std::vector<QRect> PanelFigure::axesRects() const {
  std::vector<QRect> rects;
  for (const std::size_t i : shown_) rects.push_back(panels_[i].axes->rect());
  return rects;
}

void PanelFigure::chooseHeaders() {
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Panel& panel = panels_[shown_[i]];
    const bool below = columns_ == 1 && i > 0 && panels_[shown_[i - 1]].group == panel.group;
    panel.header->setLines(below || panel.alone.empty() ? panel.lines : panel.alone);
  }
}

void PanelFigure::arrange(int columns) {
  if (columns == columns_ || shown_.empty()) return;
  columns_ = columns;
  for (const Panel& panel : panels_) {
    if (panel.cell->layout()) panel.cell->layout()->take(panel.cell);
    panel.axes->setMarginGroup(QCP::msLeft | QCP::msRight | QCP::msBottom, nullptr);
  }
  grid_->simplify();
  qDeleteAll(groups_);
  groups_.clear();
  for (int row = 0; row < grid_->rowCount(); ++row) grid_->setRowStretchFactor(row, 1.0);
  const int rows = (static_cast<int>(shown_.size()) + columns - 1) / columns;
  for (int i = 0; i < columns + rows; ++i) groups_.push_back(new QCPMarginGroup(this));
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    const Panel& panel = panels_[shown_[i]];
    grid_->addElement(row, column, panel.cell);
    panel.axes->setMarginGroup(QCP::msLeft, groups_[static_cast<std::size_t>(column)]);
    panel.axes->setMarginGroup(QCP::msBottom, groups_[static_cast<std::size_t>(columns + row)]);
  }
}

/// Items in panels of other pages are not drawn, and take no part in the layout.
void PanelFigure::hideOthers() {
  const auto isShown = [&](const QCPAxisRect* axes) {
    return std::any_of(shown_.begin(), shown_.end(), [&](std::size_t i) { return panels_[i].axes == axes; });
  };
  if (shown_.size() == panels_.size()) return;
  for (const Panel& panel : panels_) panel.cell->setVisible(isShown(panel.axes));
  for (int i = 0; i < itemCount(); ++i)
    for (const QCPItemPosition* position : item(i)->positions())
      if (position->axisRect() && !isShown(position->axisRect())) item(i)->setVisible(false);
}

void PanelFigure::styleAxes(const Panel& panel) const {
  panel.axes->setBackground(QBrush(theme_->surface));
  panel.empty->setColor(theme_->muted);
  panel.empty->setFont(textFont(scale_.text));
  for (QCPAxis* axis : panel.axes->axes()) {
    axis->setBasePen(QPen(theme_->muted, 0.8));
    axis->setTickPen(QPen(theme_->muted, 0.8));
    axis->setTickLabelColor(theme_->text);
    axis->setLabelColor(theme_->text);
    axis->setTickLabelFont(textFont(scale_.tick));
    axis->setLabelFont(textFont(scale_.tick));
    axis->setLabelPadding(axis->axisType() == QCPAxis::atLeft ? 4 : 2);  // beside numbers, below them
    axis->setTickLabelPadding(2);
    axis->grid()->setPen(QPen(theme_->grid, 0.8));
  }
}

void PanelFigure::layOutPanels() {
  plotLayout()->update(QCPLayoutElement::upPreparation);
  plotLayout()->update(QCPLayoutElement::upMargins);
  plotLayout()->update(QCPLayoutElement::upLayout);
}

/// Sets labels and units of the axes. If panels below each other share an x axis, or with `one_label`, only
/// the lowest panel has an x label.
void PanelFigure::fitLabels(bool one_label) {
  const auto& first = panels_[shown_.empty() ? 0 : shown_[0]].x_label;
  const bool same =
      std::all_of(shown_.begin(), shown_.end(), [&](std::size_t i) { return panels_[i].x_label == first; });
  const auto isLowest = [&](std::size_t i) {
    return i + static_cast<std::size_t>(columns_) >= shown_.size();
  };
  for (std::size_t i = 0; i < shown_.size(); ++i) label(panels_[shown_[i]], isLowest(i), same && one_label);
  layOutPanels();
  const QFont font = textFont(scale_.tick);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    QCPAxis* x = panels_[shown_[i]].axes->axis(QCPAxis::atBottom);
    const double room = panels_[shown_[i]].axes->width() + 2.0 * QFontMetricsF(font).height();
    if (QFontMetricsF(font).horizontalAdvance(x->label()) > room)
      x->setLabel(wrapText(x->label().replace(QLatin1String(" ["), QStringLiteral("\u00a0[")), font, room)
                      .join(QLatin1Char('\n')));
  }
  layOutPanels();
}

void PanelFigure::label(const Panel& panel, bool lowest, bool one_label) {
  const double height = QFontMetricsF(textFont(scale_.tick)).height();
  QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
  x->setTickLabels(lowest || !sharesX());
  x->setLabel(lowest || !(sharesX() || one_label) ? panel.x_label : QString());
  panel.axes->axis(QCPAxis::atLeft)->setLabel(panel.y_label);
  panel.axes->setMinimumMargins(QMargins(4, 3, static_cast<int>(0.9 * height), 3));
}

/// Cuts the y labels to their units where one is longer than its axis, and would overlap the header; in a
/// window that is too low for the units, to their names.
void PanelFigure::fitYLabels() const {
  const QFontMetricsF metrics(textFont(scale_.tick));
  using Cut = QString (*)(const QString& label);
  const Cut whole = [](const QString& label) { return label; };
  const Cut unit = [](const QString& label) { return label.mid(label.lastIndexOf(QLatin1Char('['))); };
  const Cut name = [](const QString& label) {
    return label.left(label.lastIndexOf(QLatin1Char('['))).trimmed();
  };
  for (const Cut words : {whole, unit, name}) {
    bool fits = true;
    for (const std::size_t i : shown_) {
      const QString label = words(panels_[i].y_label);
      panels_[i].axes->axis(QCPAxis::atLeft)->setLabel(label);
      fits = fits && metrics.horizontalAdvance(label) <= panels_[i].axes->height();
    }
    if (fits) break;
  }
}

/// Sets as many numbers as fit without overlap, and room for half of the numbers at the ends.
void PanelFigure::fitTicks() {
  layOutPanels();
  const double height = QFontMetricsF(textFont(scale_.tick)).height();
  for (const std::size_t i : shown_) {
    const QCPAxisRect& axes = *panels_[i].axes;
    fitTickCount(*axes.axis(QCPAxis::atBottom),
                 std::min(10, static_cast<int>(axes.width() / (2.4 * height))));
    fitTickCount(*axes.axis(QCPAxis::atLeft), std::min(7, static_cast<int>(axes.height() / (1.9 * height))));
  }
  layOutPanels();
  for (const std::size_t i : shown_) {
    QMargins margins = panels_[i].axes->minimumMargins();
    margins.setTop(std::max(margins.top(), overhang(*panels_[i].axes->axis(QCPAxis::atLeft))));
    margins.setRight(std::max(margins.right(), overhang(*panels_[i].axes->axis(QCPAxis::atBottom))));
    panels_[i].axes->setMinimumMargins(margins);
  }
  layOutPanels();
  if (sharesX()) balanceRows();
  fitYLabels();
  layOutPanels();
}

/// Makes axes below each other equally high, whatever is above and below them.
void PanelFigure::balanceRows() {
  const auto columns = static_cast<std::size_t>(columns_);
  std::vector<double> beside((shown_.size() + columns - 1) / columns, 0.0);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const Panel& panel = panels_[shown_[i]];
    double& most = beside[i / columns];
    most = std::max<double>(most, panel.cell->outerRect().height() - panel.axes->height());
  }
  double left = grid_->rect().height();
  for (const double height : beside) left -= height;
  for (std::size_t row = 0; row < beside.size(); ++row)
    grid_->setRowStretchFactor(static_cast<int>(row),
                               std::max(1.0, beside[row] + left / static_cast<double>(beside.size())));
  layOutPanels();
}

void PanelFigure::resizeEvent(QResizeEvent* event) {
  QCustomPlot::resizeEvent(event);
  fit();
}

}  // namespace capstan::widgets
