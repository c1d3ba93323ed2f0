#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/experiments/results.h"
#include "widgets/figures/figure.h"

namespace capstan::widgets {

enum class FigureKind { kTrajectory, kParameters, kHistogram, kBoxplot };

/// A figure that can be drawn from results, created on demand.
struct ExperimentFigure {
  std::string name;  ///< name of its files: letters, digits and -
  FigureKind kind = FigureKind::kTrajectory;
  std::function<std::unique_ptr<Figure>()> make;
};

/// The figures of the UKF paper that `results` have data for. `results` must outlive the figures.
/// - 5 and 8, NAME-trajectory-TRIAL: tracked trials, and trials that were used for identification. For the
///   first of them also NAME-detail-TRIAL: 20 s about its first occlusion.
/// - 6 and 7, NAME-parameters-KIND: estimates over time, one figure per kind (r_l; k_e and b_e; f_c).
/// - 9, NAME-histogram-TRIAL: kinematic and UKF errors.
/// - 10 to 12, NAME-boxplot-joint-J: one group per trial; NAME-boxplot for a single trial.
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
