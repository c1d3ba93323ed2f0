#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "widgets/panels/learning/learning_view.h"

class QCheckBox;

namespace capstan::widgets {

class CloudView;

/// Positions in 3-D before and after correction: commanded, observed, with the rigid offset, corrected.
/// Rejected states have the colour of warnings.
class CloudsView : public LearningView {
  Q_OBJECT

 public:
  enum Layer { kCommanded, kVisible, kOffset, kCorrected, kRejected, kLayers };

  explicit CloudsView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme) override;
  void showResults(const LearningResults& results) override;
  CloudView& view() { return *view_; }
  QCheckBox& layer(Layer which) { return *layers_[which]; }

 private:
  void gather();
  void draw();
  QColor colourOf(Layer layer) const;

  Theme theme_ = Theme::dark();
  LearningResults results_;
  std::array<std::vector<Eigen::Vector3d>, kLayers> points_;
  std::array<QCheckBox*, kLayers> layers_{};
  CloudView* view_;
};

}  // namespace capstan::widgets
