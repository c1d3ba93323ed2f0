#pragma once

#include <array>
#include <optional>

#include "core/base/progress_part.h"
#include "core/learning/gaussian_process/committee.h"
#include "core/learning/gaussian_process/process_fit.h"
#include "core/learning/poses/pose_features.h"

namespace capstan::learning {

struct CorrectionOptions {
  /// History pays with thousands of states, and misleads with hundreds; unset: as chooseMotion() finds.
  std::optional<Motion> motion = Motion::kVelocity;
  RotationForm rotation = RotationForm::kTangent;
  int members = 3;                       ///< of each committee; one where it would have all states
  Eigen::Index likelihood_points = 800;  ///< states that a member's hyperparameters are learned from, at most
  Eigen::Index inducing_points = 1000;   ///< of a member, at most
  ProcessFitOptions fit{.kernel = Kernel::kMatern, .farthest_signal = 3.0, .farthest_noise = 2.5};
  double lever = kLever;
  std::optional<Eigen::Isometry3d> offset = std::nullopt;  ///< G; unset: least squares of the states
  int threads = 2;
  std::uint64_t seed = 1;
  bool calibrate = true;  ///< σ, by motions held out
};

/// The command, and its confidence.
struct Corrected {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Of the correction, with the noise of the training data: position along the axes of the commands [m],
  /// rotation about the tool's [rad]. Of a model without processes the RMS of what the rigid offset left.
  Vector6d sigma = Vector6d::Zero();
  /// 1 − variance / variance without data, of all outputs together (rotations by the lever): 1 where the data
  /// are dense; times the factor by which corrections fade outside of the workspace.
  double confidence = 0.0;
};

/// Commanded ⊖ corrected pose, in units of the stated σ.
Vector6d errorsInSigma(const Corrected& corrected, const Eigen::Isometry3d& commanded);

/// Everything that a model knows, as a file keeps it.
struct CorrectionParts {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< G
  PoseFeatures features{RotationForm::kTangent, Motion::kHistory, Eigen::Quaterniond::Identity()};
  double lever = kLever;
  Eigen::AlignedBox3d turns;             ///< of their rotation vectors from the features' mean rotation [rad]
  Eigen::AlignedBox3d workspace;         ///< of the offset's positions [m]
  Eigen::RowVectorXd middle, deviation;  ///< of the features
  Eigen::RowVectorXd scale;              ///< RMS of the six targets
  Eigen::RowVectorXd inflation;          ///< of the outputs' σ, so that they hold for motions not learned
  /// Members' of x, of y, of z and of the rotation; none: the rigid offset alone.
  std::vector<std::vector<SparseProcessParts>> groups;
};

/// F = H ∘ G (GPR paper, section III): the command so that cameras see a desired state. G is the rigid
/// offset; H are Gaussian processes of the difference that G leaves, whose mean is 0 far from all data: a
/// committee each of x, y and z, and one of the rotation, whose three outputs share kernels. Features are
/// standardised and limited to ±kFarthestFeature. A process that learned no dependence on position would not
/// return to zero far from the data; therefore every correction also fades as exp(−½ d²/kFade²), with d the
/// distance from the boxes of all training positions and rotations, rotations by the lever.
class CorrectionModel {
 public:
  /// From states that count; `part` of `progress` is its own. base::InputError: fewer than kFewestStates.
  /// Cancelled: of a rigid offset alone.
  static CorrectionModel trained(const std::vector<State>& states, const CorrectionOptions& options = {},
                                 base::Progress* progress = nullptr, const base::ProgressPart& part = {});
  /// Of the rigid offset alone.
  static CorrectionModel rigid(const std::vector<State>& states, const CorrectionOptions& options = {});
  explicit CorrectionModel(CorrectionParts parts);

  /// Command for a desired state: its observed pose, velocity and history in the cameras' frame.
  Corrected correct(const State& desired) const;
  /// The same of a steady motion.
  Corrected correct(const Eigen::Isometry3d& desired, const Vector6d& velocity) const;
  /// The same of many.
  std::vector<Corrected> correctWithConfidence(const std::vector<State>& desired) const;
  /// Poses alone, faster.
  std::vector<Eigen::Isometry3d> correct(const std::vector<State>& desired) const;

  /// Corrected::confidence of many.
  Eigen::VectorXd confidence(const std::vector<State>& desired) const;

  /// Learns more states with the same hyperparameters and inducing points.
  void add(const std::vector<State>& states);

  const Eigen::Isometry3d& offset() const { return known_.offset; }
  const PoseFeatures& features() const { return known_.features; }
  Motion motion() const { return known_.features.motion(); }
  const Eigen::AlignedBox3d& workspace() const { return known_.workspace; }
  /// Processes of x, y, z and of the rotation; their outputs are in units of their scale.
  const std::vector<Committee>& processes() const { return processes_; }
  /// Weight of a committee's variance in the total variance [m²]: its outputs' scales, rotations by the
  /// lever.
  double weightOf(std::size_t process) const;
  CorrectionParts parts() const;

  /// Inputs and targets of the processes, a row a state: features in deviations, outputs in scales.
  Eigen::MatrixXd featuresOf(const std::vector<State>& states) const;
  Eigen::MatrixXd targetsOf(const std::vector<State>& states) const;

 private:
  void findScales(const std::vector<State>& states);
  void findInflation(const std::vector<State>& states, const CorrectionOptions& options);
  void addRatios(const std::vector<State>& observed, const std::vector<State>& held,
                 const CorrectionOptions& options, std::array<std::vector<double>, 6>& ratios) const;
  Eigen::Vector3d turnOf(const Eigen::Isometry3d& moved) const;  ///< from the features' middle [rad]
  void extendBy(const Eigen::Isometry3d& moved);
  double fading(const Eigen::Isometry3d& moved) const;

  CorrectionParts known_;  ///< without groups
  std::vector<Committee> processes_;
};
/// Below this confidence a pose is corrected by little more than the rigid offset.
inline constexpr double kLowConfidence = 0.5;
/// Shares of a normal distribution: σ are calibrated by them.
inline constexpr double kWithinSigma = 0.6827, kWithinTwoSigma = 0.9545;
inline constexpr std::size_t kFewestStates = 20;
inline constexpr double kFarthestFeature = 4.0;
inline constexpr double kFade = 0.01;  ///< [m]

}  // namespace capstan::learning
