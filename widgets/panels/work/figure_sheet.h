#pragma once

#include <QWidget>
#include <memory>

#include "widgets/figures/panel_figure.h"

class QLabel;
class QVBoxLayout;

namespace capstan::widgets {

/// Area for one figure, or for a text while there is none.
class FigureSheet : public QWidget {
  Q_OBJECT

 public:
  explicit FigureSheet(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Shows `figure`; null: none.
  void setFigure(std::unique_ptr<PanelFigure> figure);
  void setEmptyWords(const QString& words);
  PanelFigure* figure() const { return figure_; }
  QSize minimumSizeHint() const override { return {220, 150}; }

 private:
  const Theme* theme_ = &Theme::dark();
  QVBoxLayout* column_;
  QLabel* empty_;
  PanelFigure* figure_ = nullptr;
};

}  // namespace capstan::widgets
