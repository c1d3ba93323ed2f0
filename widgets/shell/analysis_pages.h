#pragma once

#include <QTabWidget>

#include "widgets/figures/theme.h"

class QSettings;

namespace capstan::widgets {

class AnalysisPanel;
class ExperimentsPanel;

/// The pages of Analysis: errors of runs, and the experiments of the GPR paper.
class AnalysisPages : public QTabWidget {
  Q_OBJECT

 public:
  explicit AnalysisPages(QWidget* parent = nullptr);

  AnalysisPanel& errors() { return *errors_; }
  ExperimentsPanel& experiments() { return *experiments_; }
  void setTheme(const Theme& theme);
  void save(QSettings& settings) const;
  void restore(const QSettings& settings);

 private:
  AnalysisPanel* errors_;
  ExperimentsPanel* experiments_;
};

}  // namespace capstan::widgets
