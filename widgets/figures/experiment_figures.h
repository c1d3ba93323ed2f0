#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/experiments/results.h"
#include "widgets/figures/figure.h"

namespace capstan::widgets {

enum class FigureKind { kTrajectory, kParameters, kHistogram, kBoxplot };

/// A figure that results support, made when it is needed.
struct ExperimentFigure {
  std::string name;  ///< for its files: letters, digits and -
  FigureKind kind = FigureKind::kTrajectory;
  std::function<std::unique_ptr<Figure>()> make;
};

/// The UKF paper's figures, as far as `results` hold what they show. It must outlive what is made.
/// - 5 and 8, NAME-trajectory-TRIAL, of tracked trials and of those that were identified from; of the first
///   also NAME-detail-TRIAL, 20 s about its first occlusion.
/// - 6 and 7, NAME-parameters-KIND: estimates over time, those of one kind (r_l; k_e and b_e; f_c) together.
/// - 9, NAME-histogram-TRIAL: kinematic and UKF errors.
/// - 10 to 12, NAME-boxplot-joint-J: a group a trial; NAME-boxplot of a single trial.
/// - 13, NAME-boxplot-occlusion: |error| of the UKF by occlusion, where trials differ in it.
std::vector<ExperimentFigure> figuresOf(const experiments::Results& results);

}  // namespace capstan::widgets

template <>
struct capstan::base::NamesOf<capstan::widgets::FigureKind> {
  using K = capstan::widgets::FigureKind;
  static constexpr std::array value = {
      std::pair{K::kTrajectory, "trajectories"}, std::pair{K::kParameters, "parameters"},
      std::pair{K::kHistogram, "histograms"}, std::pair{K::kBoxplot, "boxplots"}};
};
