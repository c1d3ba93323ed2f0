#pragma once

#include "widgets/panels/learning/learning_view.h"

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTreeWidget;

namespace capstan::widgets {

/// Table I of the GPR paper: the error with each part of the method, over random splits by trajectory, with
/// the paper's numbers below ours.
class AblationView : public LearningView {
  Q_OBJECT

 public:
  explicit AblationView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  /// Enables the run. `ready`: there are states to run on, and no work is running.
  void setReady(bool ready);
  int splits() const;
  void setSplits(int splits);
  /// Rows as text: "offset, GP | ours | 1.21 ± 0.98 | …".
  QStringList lines() const;

 signals:
  void runRequested();

 private:
  void fill();
  void addMethod(learning::CorrectionMethod method, bool clean);

  Theme theme_ = Theme::dark();
  std::shared_ptr<const learning::CorrectionStudyReport> study_;
  int of_splits_ = 0;
  QSpinBox* splits_;
  QPushButton* run_;
  QComboBox* which_;
  QLabel* words_;
  QTreeWidget* table_;
};

}  // namespace capstan::widgets
