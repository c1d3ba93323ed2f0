#pragma once

#include <qcustomplot.h>

#include <vector>

#include "widgets/figures/figure.h"
#include "widgets/figures/figure_legend.h"
#include "widgets/figures/text_row.h"

namespace capstan::widgets {

/// Sizes of everything in a figure that is laid out for a width: text in typographic points, lines in pixels
/// of 1/96 inch. From a single column (88 mm: 6.5 points) to a window.
struct SheetScale {
  double title = 9.0, text = 8.0, tick = 7.5;
  double line = 1.0;  ///< width of an outline

  static SheetScale of(double width);
};

/// What figures of several panels share: a title and a note, one legend, and panels in rows and columns, each
/// with a header over its axes. Concrete figures fill the axes.
class PanelFigure : public QCustomPlot, public Figure {
  Q_OBJECT
 public:
  struct Panel {
    QCPLayoutGrid* cell;
    TextRow* header;
    QCPAxisRect* axes;
    QString x_label, y_label;  ///< too long for its axis, y_label loses its unit, then all
    QCPItemText* empty;        ///< says that there is nothing to show, where there is not
  };

  QCustomPlot& canvas() override { return *this; }
  void setTheme(const Theme& theme) override;
  QString caption() const override;

  const TextRow& title() const { return *title_; }
  const FigureLegend& legend() const { return *legend_; }
  const std::vector<Panel>& panels() const { return panels_; }
  const Theme& theme() const { return *theme_; }
  const SheetScale& scale() const { return scale_; }

 protected:
  explicit PanelFigure(QWidget* parent);

  void setTitle(const QString& title, const QString& note);
  void setLegend(std::vector<LegendEntry> entries) { legend_->setEntries(std::move(entries)); }
  /// In axes of its own, or in those given, which the caller has dressed.
  Panel& addPanel(std::vector<TextRow::Line> header, const QString& x_label, const QString& y_label,
                  QCPAxisRect* axes = nullptr);
  /// Lays out anew for the present size and theme; to be called at the end of a figure's constructor.
  void fit();

  /// All panels have one x axis: its numbers stand below the lowest only.
  virtual bool sharesX() const { return false; }
  /// Panels side by side in a figure of this size.
  virtual int columnsFor(QSize size) const = 0;
  /// Takes theme() and scale() to what is drawn in the panels.
  virtual void restyle() = 0;
  /// The panels have their places: what depends on them in pixels may be chosen.
  virtual void laidOut() {}

  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange(int columns);
  void styleAxes(const Panel& panel) const;
  void fitHeaders(double width, bool brief);
  void layOutPanels();
  void balanceRows();
  void fitLabels();

  const Theme* theme_;
  SheetScale scale_;
  TextRow* title_;
  FigureLegend* legend_;
  QCPLayoutGrid* grid_;
  std::vector<Panel> panels_;
  std::vector<QCPMarginGroup*> groups_;
  int columns_ = 0;
};

}  // namespace capstan::widgets
