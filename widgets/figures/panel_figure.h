#pragma once

#include <qcustomplot.h>

#include <vector>

#include "widgets/figures/figure.h"
#include "widgets/figures/figure_legend.h"
#include "widgets/figures/text_row.h"

namespace capstan::widgets {

/// Sizes in a figure that is laid out for a width, from a single column (88 mm: 6.5 points) to a window: text
/// in typographic points, lines in pixels of 1/96 inch.
struct SheetScale {
  double title = 9.0, text = 8.0, tick = 7.5;
  double line = 1.0;  ///< line width of an outline

  static SheetScale of(double width);
};

/// Base class of figures with several panels: a title and a note, one legend, and panels in rows and columns,
/// each with a header above its axes. Derived classes draw into the axes.
class PanelFigure : public QCustomPlot, public Figure {
  Q_OBJECT
 public:
  struct Panel {
    QCPLayoutGrid* cell;
    TextRow* header;
    QCPAxisRect* axes;
    QString x_label, y_label;  ///< with units in brackets; a y_label that is too long is cut to its unit
    QCPItemText* empty;        ///< text shown in a panel without data
    int group;                 ///< panels of one group share a page
    std::vector<TextRow::Line> lines;  ///< lines of the header
    /// Lines of the header if no panel of the same group is above; empty: `lines`.
    std::vector<TextRow::Line> alone = {};
  };

  QCustomPlot& canvas() override { return *this; }
  void setTheme(const Theme& theme) override;
  QString caption() const override;

  const TextRow& title() const { return *title_; }
  const FigureLegend& legend() const { return *legend_; }
  const std::vector<Panel>& panels() const { return panels_; }
  const Theme& theme() const { return *theme_; }
  const SheetScale& scale() const { return scale_; }

  static constexpr int kLeastAxesHeight = 38;  ///< on paper: 10 mm, three numbers above each other [px]
  static constexpr int kLeastAxesWidth = 60;   ///< [px]

  /// Shows or hides title and note above the panels. caption() includes them in both cases.
  void setTitled(bool titled);
  /// Sets the panels that are drawn, by index, in their order; all others are absent.
  void setShown(std::vector<std::size_t> panels);
  const std::vector<std::size_t>& shown() const { return shown_; }
  /// Whether texts are omitted where axes would be lower than leastHeight(): a window has only one page.
  void setYielding(bool yielding);
  /// Whether everything shown has the room that it needs at the present size.
  bool fits() const;

 protected:
  explicit PanelFigure(QWidget* parent);

  void setTitle(const QString& title, const QString& note);
  void setLegend(std::vector<LegendEntry> entries) { legend_->setEntries(std::move(entries)); }
  /// Adds a panel, with new axes or with `axes`, which the caller has styled.
  Panel& addPanel(std::vector<TextRow::Line> header, const QString& x_label, const QString& y_label,
                  QCPAxisRect* axes = nullptr);
  /// Sets the group of the panels added from now on. Before the first call each panel is a group of its own.
  void setGroup(int group) { group_ = group; }
  /// Lays out for the present size and theme. Call it at the end of the constructor of a derived class.
  void fit();

  /// Least height of the axes of a panel [px], for panels that need more than kLeastAxesHeight.
  virtual int leastHeight(std::size_t) const { return kLeastAxesHeight; }
  /// Whether all panels share one x axis: its numbers are then shown only below the lowest panel.
  virtual bool sharesX() const { return false; }
  /// Number of panels side by side in a figure of this size.
  virtual int columnsFor(QSize size) const = 0;
  /// Applies theme() and scale() to the content of the panels.
  virtual void restyle() = 0;
  /// Called when the panels have their positions, for choices that depend on pixels.
  virtual void laidOut() {}

  void resizeEvent(QResizeEvent* event) override;

 private:
  /// Texts that a crowded figure in a window omits, one after another.
  enum class Words { kAll, kNoSecondRank, kNoNote, kOneLabel };

  void fitWords(Words words);
  std::vector<QRect> axesRects() const;
  void arrange(int columns);
  void styleAxes(const Panel& panel) const;
  void chooseHeaders();
  void layOutPanels();
  void balanceRows();
  void label(const Panel& panel, bool lowest, bool one_label);
  void fitLabels(bool one_label);
  void fitYLabels() const;
  void fitTicks();
  void hideOthers();

  const Theme* theme_;
  SheetScale scale_;
  TextRow* title_;
  FigureLegend* legend_;
  QCPLayoutGrid* grid_;
  std::vector<Panel> panels_;
  std::vector<std::size_t> shown_;
  std::vector<QCPMarginGroup*> groups_;
  int columns_ = 0, group_ = -1;
  bool titled_ = true, yielding_ = true;
};

}  // namespace capstan::widgets
