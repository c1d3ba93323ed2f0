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
    QString x_label, y_label;  ///< with a unit in brackets; too long for its axis, y_label is the unit alone
    QCPItemText* empty;        ///< says that there is nothing to show, where there is not
    int group;                 ///< panels of one group stand on one page
    std::vector<TextRow::Line> lines;  ///< its header
    /// The header where it does not stand below another panel of its group; empty: `lines`.
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

  static constexpr int kLeastAxesHeight = 38;  ///< on paper: 10 mm, three numbers upon each other [px]
  static constexpr int kLeastAxesWidth = 60;   ///< [px]

  /// Whether title and note stand above the panels; they are the caption all the same.
  void setTitled(bool titled);
  /// Panels that are drawn, by index, in their order; all others are not there.
  void setShown(std::vector<std::size_t> panels);
  const std::vector<std::size_t>& shown() const { return shown_; }
  /// Whether words give way where axes would be lower than leastHeight(): a window has but one page.
  void setYielding(bool yielding);
  /// Whether all that is shown has the room that it needs at the present size.
  bool fits() const;

 protected:
  explicit PanelFigure(QWidget* parent);

  void setTitle(const QString& title, const QString& note);
  void setLegend(std::vector<LegendEntry> entries) { legend_->setEntries(std::move(entries)); }
  /// In axes of its own, or in those given, which the caller has dressed.
  Panel& addPanel(std::vector<TextRow::Line> header, const QString& x_label, const QString& y_label,
                  QCPAxisRect* axes = nullptr);
  /// Of the panels added from now on; before the first call each is a group of its own.
  void setGroup(int group) { group_ = group; }
  /// Lays out again for the present size and theme; to be called at the end of a figure's constructor.
  void fit();

  /// Of the axes of a panel, where it needs more than most [px].
  virtual int leastHeight(std::size_t) const { return kLeastAxesHeight; }
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
  /// What a crowded figure in a window omits, one after another.
  enum class Words { kAll, kNoSecondRank, kNoNote, kOneLabel };

  void fitWords(Words words);
  void arrange(int columns);
  void styleAxes(const Panel& panel) const;
  void chooseHeaders();
  void layOutPanels();
  void balanceRows();
  void label(const Panel& panel, bool lowest, bool one_label);
  void fitLabels(bool one_label);
  void fitYLabel(const Panel& panel) const;
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
