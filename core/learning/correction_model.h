#pragma once

#include "core/base/progress_part.h"
#include "core/learning/pose_features.h"
#include "core/learning/process_fit.h"
#include "core/learning/sparse_process.h"

namespace capstan::learning {

struct CorrectionOptions {
  bool velocity = true;
  RotationForm rotation = RotationForm::kTangent;
  Eigen::Index likelihood_points = 1500;  ///< states that the hyperparameters are learned from, at most
  Eigen::Index inducing_points = 1500;    ///< at most
  ProcessFitOptions fit;
  double lever = kLever;
  int threads = 2;
  std::uint64_t seed = 1;
};

/// What is to be asked for, and how sure that is.
struct Corrected {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Vector6d sigma =
      Vector6d::Zero();  ///< of the correction: position [m], turn [rad]; with the noise of what was learned
  /// 1 − variance / variance without data, of all outputs together (turns by the lever): 1 where the data are
  /// dense; times what is left of the correction beyond the workspace.
  double confidence = 0.0;
};

/// F = H ∘ G (GPR paper, section III): what to ask for so that cameras see a desired state. G is the rigid
/// offset; H a Gaussian process an output, of the difference that G leaves, whose mean is 0 far from all
/// data. An output that does not depend on where the tip is has no such distance: all corrections fade
/// besides, as exp(−½ d²/kFade²) of the distance d from the box of all positions learned.
class CorrectionModel {
 public:
  /// From states that count; `part` of `progress` is its own. base::InputError: fewer than kFewestStates.
  /// Cancelled: of a rigid offset alone.
  static CorrectionModel trained(const std::vector<State>& states, const CorrectionOptions& options = {},
                                 base::Progress* progress = nullptr, const base::ProgressPart& part = {});

  /// `desired` and its velocity in the cameras' frame.
  Corrected correct(const Eigen::Isometry3d& desired, const Vector6d& velocity) const;
  /// Poses alone, faster.
  std::vector<Eigen::Isometry3d> correct(const std::vector<State>& seen) const;
  /// Corrected::confidence of many, a hundred times as fast.
  Eigen::VectorXd confidence(const std::vector<State>& desired) const;

  /// Learns more states with the same hyperparameters and inducing points.
  void add(const std::vector<State>& states);

  const Eigen::Isometry3d& offset() const { return offset_; }
  const std::vector<SparseProcess>& processes() const {
    return processes_;
  }  ///< of outputs in units of scale

 private:
  CorrectionModel(const Eigen::Isometry3d& offset, PoseFeatures features)
      : offset_(offset), features_(std::move(features)) {}
  Vector6d turnedVelocity(const Vector6d& velocity) const;
  Eigen::MatrixXd featuresOf(const std::vector<State>& states) const;  ///< in deviations
  Eigen::MatrixXd targetsOf(const std::vector<State>& states) const;   ///< in scales
  void findScales(const std::vector<State>& states);
  double weightOf(Eigen::Index output) const;  ///< of its variance in the confidence [m²]
  double fading(const Eigen::Vector3d& position) const;

  Eigen::Isometry3d offset_;
  PoseFeatures features_;
  double lever_ = kLever;
  Eigen::AlignedBox3d workspace_;          ///< of the offset's positions
  Eigen::RowVectorXd middle_, deviation_;  ///< of the features
  Eigen::RowVectorXd scale_;               ///< RMS of the targets
  std::vector<SparseProcess> processes_;   ///< by output
};
inline constexpr std::size_t kFewestStates = 20;
inline constexpr double kFade = 0.01;  ///< [m]

}  // namespace capstan::learning
