#include "widgets/figures/panel_figure.h"

#include <algorithm>

#include "widgets/figures/round_ticker.h"

namespace capstan::widgets {

namespace {

constexpr int kMargin = 6;            ///< about everything [px]
constexpr int kLeastAxesHeight = 34;  ///< below it headers lose their second rank [px]
constexpr int kPanelSpacing = 10;     ///< between panels [px]

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
  Panel panel{new QCPLayoutGrid, new TextRow(this), axes ? axes : new QCPAxisRect(this, true),
              x_label,           y_label,           nullptr};
  panel.header->setLines(std::move(header));
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
  panels_.push_back(panel);
  columns_ = 0;
  return panels_.back();
}

void PanelFigure::setTheme(const Theme& theme) {
  theme_ = &theme;
  fit();
}

void PanelFigure::fit() {
  setViewport(rect());
  scale_ = SheetScale::of(width());
  const double inner = width() - 2.0 * kMargin;
  setBackground(QBrush(theme_->surface));
  title_->setColours(theme_->text, theme_->muted);
  title_->fit(scale_.title, scale_.text, inner);
  restyle();
  legend_->setColour(theme_->text);
  legend_->fit(scale_.text, inner);
  const int columns = std::clamp(columnsFor(size()), 1, std::max(1, static_cast<int>(panels_.size())));
  arrange(columns);
  const double wide = (inner - (columns - 1) * kPanelSpacing) / columns;
  for (const Panel& panel : panels_) styleAxes(panel);
  fitHeaders(wide, false);
  fitLabels();
  const bool crowded = std::any_of(panels_.begin(), panels_.end(), [](const Panel& panel) {
    return panel.axes->height() < kLeastAxesHeight;
  });
  if (crowded) {
    fitHeaders(wide, true);
    fitLabels();
  }
  laidOut();
  replot(rpQueuedReplot);
}

void PanelFigure::arrange(int columns) {
  if (columns == columns_ || panels_.empty()) return;
  columns_ = columns;
  for (const Panel& panel : panels_) {
    if (panel.cell->layout()) grid_->take(panel.cell);
    panel.axes->setMarginGroup(QCP::msLeft | QCP::msRight | QCP::msBottom, nullptr);
  }
  grid_->simplify();
  qDeleteAll(groups_);
  groups_.clear();
  for (int row = 0; row < grid_->rowCount(); ++row) grid_->setRowStretchFactor(row, 1.0);
  const int rows = (static_cast<int>(panels_.size()) + columns - 1) / columns;
  for (int i = 0; i < columns + rows; ++i) groups_.push_back(new QCPMarginGroup(this));
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    grid_->addElement(row, column, panels_[i].cell);
    panels_[i].axes->setMarginGroup(QCP::msLeft, groups_[static_cast<std::size_t>(column)]);
    panels_[i].axes->setMarginGroup(QCP::msBottom, groups_[static_cast<std::size_t>(columns + row)]);
  }
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

void PanelFigure::fitHeaders(double width, bool brief) {
  for (const Panel& panel : panels_) {
    panel.header->setBrief(brief);
    panel.header->setColours(theme_->text, theme_->muted);
    panel.header->fit(scale_.text, scale_.tick, width);
  }
}

void PanelFigure::layOutPanels() {
  plotLayout()->update(QCPLayoutElement::upPreparation);
  plotLayout()->update(QCPLayoutElement::upMargins);
  plotLayout()->update(QCPLayoutElement::upLayout);
}

/// Labels and as many numbers as there is room for. Where panels of one x label stand below each other, the
/// x axis is labelled below the lowest; a value axis too short for its label has its unit in the panel's
/// header. A label with a unit stays beside its axis: beyond it, it would stand between the topmost number
/// and the header.
void PanelFigure::fitLabels() {
  const QFontMetricsF metrics(textFont(scale_.tick));
  const double label = metrics.height();
  const bool one_label = std::all_of(panels_.begin(), panels_.end(),
                                     [&](const Panel& panel) { return panel.x_label == panels_[0].x_label; });
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    QCPAxis* x = panels_[i].axes->axis(QCPAxis::atBottom);
    const bool lowest = i + static_cast<std::size_t>(columns_) >= panels_.size();
    x->setLabel(lowest || !one_label ? panels_[i].x_label : QString());
    x->setTickLabels(lowest || !sharesX());
    panels_[i].axes->axis(QCPAxis::atLeft)->setLabel(panels_[i].y_label);
    panels_[i].axes->setMinimumMargins(QMargins(4, 3, static_cast<int>(0.9 * label), 3));
  }
  layOutPanels();
  for (const Panel& panel : panels_) {
    QCPAxis* x = panel.axes->axis(QCPAxis::atBottom);
    QCPAxis* y = panel.axes->axis(QCPAxis::atLeft);
    const QString name = panel.y_label.section(QLatin1String(" ["), 0, 0);
    for (const QString& words : {panel.y_label, name, QString()}) {
      y->setLabel(words);
      const double room = panel.axes->height() + (words == name ? label : 0.0);
      if (metrics.horizontalAdvance(words) <= room) break;
    }
    x->ticker()->setTickCount(std::clamp(static_cast<int>(panel.axes->width() / (2.9 * label)), 2, 10));
    y->ticker()->setTickCount(std::clamp(static_cast<int>(panel.axes->height() / (1.9 * label)), 2, 7));
  }
  layOutPanels();
  if (columns_ == 1 && sharesX()) balanceRows();
}

/// Axes below each other become equally high, whatever stands above and below them.
void PanelFigure::balanceRows() {
  const auto rows = static_cast<int>(panels_.size());
  double axes = 0.0;
  std::vector<double> beside;
  for (const Panel& panel : panels_) {
    beside.push_back(panel.cell->outerRect().height() - panel.axes->height());
    axes += panel.axes->height();
  }
  for (int row = 0; row < rows; ++row)
    grid_->setRowStretchFactor(row, std::max(1.0, beside[static_cast<std::size_t>(row)] + axes / rows));
  layOutPanels();
}

void PanelFigure::resizeEvent(QResizeEvent* event) {
  QCustomPlot::resizeEvent(event);
  fit();
}

}  // namespace capstan::widgets
