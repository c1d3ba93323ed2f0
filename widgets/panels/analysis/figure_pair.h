#pragma once

#include <QScrollArea>
#include <memory>

#include "widgets/panels/analysis/analysis_figures.h"

class QBoxLayout;

namespace capstan::widgets {

/// Histogram and box plot side by side, or below each other where the width is too small; scrolled where
/// panels would become too low to read.
class FigurePair : public QScrollArea {
  Q_OBJECT

 public:
  explicit FigurePair(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void show(AnalysisFigures figures);
  void clear();
  const HistogramFigure* histogram() const { return histogram_; }
  const BoxplotFigure* boxplot() const { return boxplot_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fit();

  const Theme* theme_;
  QWidget* sheet_;
  QBoxLayout* row_;
  HistogramFigure* histogram_ = nullptr;
  BoxplotFigure* boxplot_ = nullptr;
};

}  // namespace capstan::widgets
