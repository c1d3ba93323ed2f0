#pragma once

#include <QTabWidget>

#include "widgets/figures/theme.h"
#include "widgets/panels/learning/learning_work.h"

namespace capstan::widgets {

class AblationView;
class CloudsView;
class ConfidenceView;
class CurveView;
class ErrorsView;
class LearningView;
class ReliabilityView;
class StagesView;
class TrajectoryView;

/// The pages of learning: stages, clouds, trajectories, errors, ablation, learning curve, confidence,
/// reliability; keys Alt+1 to Alt+8.
class LearningPages : public QTabWidget {
  Q_OBJECT

 public:
  explicit LearningPages(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showResults(const LearningResults& results);
  StagesView& stages() { return *stages_; }
  CloudsView& clouds() { return *clouds_; }
  TrajectoryView& trajectories() { return *trajectories_; }
  ErrorsView& errors() { return *errors_; }
  ReliabilityView& reliability() { return *reliability_; }
  AblationView& ablation() { return *ablation_; }
  CurveView& curve() { return *curve_; }
  ConfidenceView& confidence() { return *confidence_; }

 private:
  std::vector<LearningView*> views() const;

  StagesView* stages_;
  CloudsView* clouds_;
  TrajectoryView* trajectories_;
  ErrorsView* errors_;
  ReliabilityView* reliability_;
  AblationView* ablation_;
  CurveView* curve_;
  ConfidenceView* confidence_;
};

}  // namespace capstan::widgets
