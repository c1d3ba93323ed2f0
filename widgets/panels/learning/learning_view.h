#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"
#include "widgets/panels/learning/learning_work.h"

namespace capstan::widgets {

/// A page of the learning panel.
class LearningView : public QWidget {
 public:
  using QWidget::QWidget;
  virtual void setTheme(const Theme& theme) = 0;
  virtual void showResults(const LearningResults& results) = 0;
};

}  // namespace capstan::widgets
