#pragma once

#include <array>
#include <optional>

#include "core/base/progress_part.h"
#include "core/learning/gaussian_process/committee.h"
#include "core/learning/gaussian_process/process_fit.h"
#include "core/learning/poses/pose_features.h"

namespace capstan::learning {

struct CorrectionOptions {
  /// Motion features; unset: chosen by chooseMotion(). History improves models of thousands of states but
  /// degrades models of hundreds.
  std::optional<Motion> motion = Motion::kVelocity;
  RotationForm rotation = RotationForm::kTangent;
  int members = 3;                       ///< members of each committee; one if a member has all states
  Eigen::Index likelihood_points = 800;  ///< largest number of states for a member's hyperparameters
  Eigen::Index inducing_points = 1000;   ///< largest number of inducing points of a member
  ProcessFitOptions fit{.kernel = Kernel::kMatern, .farthest_signal = 3.0, .farthest_noise = 2.5};
  std::optional<Eigen::Isometry3d> offset = std::nullopt;  ///< G; unset: least squares of the states
  int threads = 2;
  std::uint64_t seed = 1;
  bool calibrate = true;  ///< calibrate σ by cross-validation over motions
};

/// A command and its confidence.
struct Corrected {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /// Standard deviation of the correction with the noise of the training data: position along the axes of the
  /// commands' frame [m], rotation about the tool's axes [rad]. For a model without processes it is the RMS
  /// residual of the rigid offset.
  Vector6d sigma = Vector6d::Zero();
  /// 1 − variance / variance without data, over all outputs (rotations by the lever), times the factor by
  /// which corrections fade outside of the workspace. It is 1 where the data are dense.
  double confidence = 0.0;
};

/// Error commanded ⊖ corrected pose, in units of the stated σ.
Vector6d errorsInSigma(const Corrected& corrected, const Eigen::Isometry3d& commanded);

/// Complete state of a model, as stored in a file.
struct CorrectionParts {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();  ///< G
  PoseFeatures features{RotationForm::kTangent, Motion::kHistory, Eigen::Quaterniond::Identity()};
  double lever = kLever;
  Eigen::AlignedBox3d turns;             ///< box of rotation vectors from the features' mean rotation [rad]
  Eigen::AlignedBox3d workspace;         ///< box of positions after the offset [m]
  Eigen::RowVectorXd middle, deviation;  ///< mean and standard deviation of the features
  Eigen::RowVectorXd scale;              ///< RMS of the six targets
  Eigen::RowVectorXd inflation;          ///< factor on σ of each output, so that σ holds for new motions
  /// Committee members for x, y, z and the rotation; empty: the rigid offset alone.
  std::vector<std::vector<SparseProcessParts>> groups;
};

/// Correction F = H ∘ G (GPR paper, section III): the command for which cameras observe a desired state. G is
/// the rigid offset. H are Gaussian processes of the residual of G, with mean 0 far from all data: one
/// committee each for x, y and z, and one for the rotation, whose three outputs share kernels. Features are
/// standardised and limited to ±kFarthestFeature. A process that does not depend on position would not return
/// to zero far from the data. Therefore every correction also fades as exp(−½ d²/kFade²), where d is the
/// distance from the boxes of all training positions and rotations (rotations by the lever).
class CorrectionModel {
 public:
  /// Trains a model from clean states and reports in `part` of `progress`. Throws base::InputError for fewer
  /// than kFewestStates. If cancelled, the model has the rigid offset alone.
  static CorrectionModel trained(const std::vector<State>& states, const CorrectionOptions& options = {},
                                 base::Progress* progress = nullptr, const base::ProgressPart& part = {});
  /// Model with the rigid offset alone.
  static CorrectionModel rigid(const std::vector<State>& states, const CorrectionOptions& options = {});
  explicit CorrectionModel(CorrectionParts parts);

  /// Command for a desired state: its observed pose, velocity and history in the cameras' frame.
  Corrected correct(const State& desired) const;
  /// Command for a steady motion with the observed pose `desired`.
  Corrected correct(const Eigen::Isometry3d& desired, const Vector6d& velocity) const;
  /// Commands for many states, with σ and confidence.
  std::vector<Corrected> correctWithConfidence(const std::vector<State>& desired) const;
  /// Commanded poses for many states without σ and confidence; faster.
  std::vector<Eigen::Isometry3d> correct(const std::vector<State>& desired) const;

  /// Corrected::confidence of many states.
  Eigen::VectorXd confidence(const std::vector<State>& desired) const;

  /// Adds training states; hyperparameters and inducing points stay.
  void add(const std::vector<State>& states);

  const Eigen::Isometry3d& offset() const { return known_.offset; }
  const PoseFeatures& features() const { return known_.features; }
  Motion motion() const { return known_.features.motion(); }
  const Eigen::AlignedBox3d& workspace() const { return known_.workspace; }
  /// Processes of x, y, z and the rotation; outputs are divided by their scale.
  const std::vector<Committee>& processes() const { return processes_; }
  /// Weight of a committee's variance in the total variance [m²]: the sum of its squared output scales
  /// (rotations by the lever).
  double weightOf(std::size_t process) const;
  CorrectionParts parts() const;

  /// Inputs and targets of the processes, one row per state: standardised features, outputs divided by their
  /// scale.
  Eigen::MatrixXd featuresOf(const std::vector<State>& states) const;
  Eigen::MatrixXd targetsOf(const std::vector<State>& states) const;

 private:
  void findScales(const std::vector<State>& states);
  void findInflation(const std::vector<State>& states, const CorrectionOptions& options);
  void addRatios(const std::vector<State>& observed, const std::vector<State>& held,
                 const CorrectionOptions& options, std::array<std::vector<double>, 6>& ratios) const;
  Eigen::Vector3d turnOf(const Eigen::Isometry3d& moved) const;  ///< rotation vector [rad]
  void extendBy(const Eigen::Isometry3d& moved);
  double fading(const Eigen::Isometry3d& moved) const;

  CorrectionParts known_;  ///< groups are empty
  std::vector<Committee> processes_;
};
/// Confidence below which the correction of a pose is little more than the rigid offset.
inline constexpr double kLowConfidence = 0.5;
/// Shares of a normal distribution within σ and 2 σ, by which σ is calibrated.
inline constexpr double kWithinSigma = 0.6827, kWithinTwoSigma = 0.9545;
inline constexpr std::size_t kFewestStates = 20;
inline constexpr double kFarthestFeature = 4.0;
inline constexpr double kFade = 0.01;  ///< [m]

}  // namespace capstan::learning
