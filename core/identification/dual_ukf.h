#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/camera_pose.h"
#include "core/identification/convergence.h"
#include "core/identification/estimate.h"
#include "core/identification/identification_data.h"
#include "core/identification/model_discrepancy.h"

namespace capstan::identification {

struct DualUkfOptions {
  CameraPoseOptions camera = {};
  /// Process noise of the states [rad/√s, rad/√s, m/√s] and [rad/s/√s, rad/s/√s, m/s/√s]. Small: speeds that
  /// wander by as much as v_eps average the friction law, and the filter finds twice the friction.
  Eigen::Vector3d position_noise{1e-4, 1e-4, 1e-5};
  Eigen::Vector3d velocity_noise{0.01, 0.01, 0.001};
  static constexpr double kMemoryShare =
      0.5;  ///< r_k of (11): what is older than this share of the time fades
  static constexpr double kShortestMemory = 5.0;  ///< [s]
  double huber = 3.37;                            ///< innovation beyond which an observation counts less
  double block = 2.0;                             ///< innovations this close in time may be correlated [s]
  static constexpr double kScoreMemory = 60.0;    ///< over which their correlation is measured [s]
  ModelDiscrepancy discrepancy = {};
  static constexpr double kTracePeriod = 0.5;  ///< [s]
};

enum class DualUkfEnd { kRecordingEnded, kSettled, kNoData, kCancelled };

struct DualUkfReport {
  DualUkfEnd end = DualUkfEnd::kNoData;
  std::vector<Estimate> estimates;  ///< in the set's order
  std::vector<Convergence> convergence;
  Trace trace;
  Eigen::MatrixXd correlation;      ///< of the logarithms
  CameraPose camera, camera_sigma;  ///< nuisance parameters and their standard deviations
  double delay_noise = 0.0;         ///< σ of camera.delay as the filter computed it, not inflated [s]
  double nis = 0.0;                 ///< mean over its 3 degrees of freedom
  double outliers = 0.0;            ///< share of observations held back
  int observations = 0;
  double used = 0.0;  ///< time of the recording that was looked at [s]
  std::uint64_t rescues = 0;
  double seconds = 0.0;  ///< of computing
};

using TraceSink = std::function<void(const TracePoint&)>;

/// Dual square-root UKF, UKF paper (11)–(12): a filter of the states that takes the parameters as known, and
/// one of the parameters (parameter_filter.h) that takes the states as known, side by side over the
/// recording. Both observe the tip seen by the cameras; joint encoders are no part of `data`.
///
/// Beyond the paper: the camera's pose and delay are nuisance parameters of the second filter; the states
/// follow the parameters by Φ Δw; and the σ stated is widened to what the innovations show. The filter
/// assumes white innovations. Where hysteresis or stiction, which the model does not know, correlate them
/// over `block` seconds, the scores g = Hᵀ R⁻¹ ν of blocks vary more than their information I states. σ is
/// multiplied by that ratio, measured over the last kScoreMemory seconds, or by the increase that the
/// transient forces of ModelDiscrepancy would cause, whichever is larger. (Its persistent force, hysteresis,
/// is counted by the batch method only.)
///
/// `sink`, if given, sees every point of the trace as it is made.
DualUkfReport identifyDualUkf(const IdentificationData& data, const ParameterSet& set,
                              const DualUkfOptions& options = {}, base::Progress* progress = nullptr,
                              const TraceSink& sink = {});

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::DualUkfEnd> {
  using E = capstan::identification::DualUkfEnd;
  static constexpr std::array value = {
      std::pair{E::kRecordingEnded, "recording ended"}, std::pair{E::kSettled, "settled"},
      std::pair{E::kNoData, "no camera observations"}, std::pair{E::kCancelled, "cancelled"}};
};

template <>
struct capstan::base::KeysOf<capstan::identification::DualUkfEnd> {
  using E = capstan::identification::DualUkfEnd;
  static constexpr std::array value = {
      std::pair{E::kRecordingEnded, "recording_ended"}, std::pair{E::kSettled, "settled"},
      std::pair{E::kNoData, "no_camera_observations"}, std::pair{E::kCancelled, "cancelled"}};
};
