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
  ModelDiscrepancy discrepancy = {};
};

enum class DualUkfEnd { kRecordingEnded, kSettled, kNoData, kCancelled };

struct DualUkfReport {
  DualUkfEnd end = DualUkfEnd::kNoData;
  std::vector<Estimate> estimates;  ///< estimates in the set's order
  std::vector<Convergence> convergence;
  Trace trace;
  Eigen::MatrixXd correlation;      ///< correlation of the logarithms
  CameraPose camera, camera_sigma;  ///< nuisance parameters and their standard deviations
  double delay_noise = 0.0;         ///< σ of camera.delay by the filter, before it is widened [s]
  double nis = 0.0;                 ///< mean normalized innovation squared / its 3 degrees of freedom
  double outliers = 0.0;            ///< share of down-weighted observations
  int observations = 0;
  double used = 0.0;          ///< processed time of the recording [s]
  std::uint64_t rescues = 0;  ///< number of repaired covariances
  double seconds = 0.0;       ///< computing time [s]
};

using TraceSink = std::function<void(const TracePoint&)>;

/// Dual square-root UKF, UKF paper (11)–(12). One filter estimates the states with the parameters as known;
/// the other one (parameter_filter.h) estimates the parameters with the states as known. Both run side by
/// side over the recording and observe the tip measured by the cameras; `data` has no joint encoders.
///
/// Beyond the paper: camera pose and delay are nuisance parameters of the second filter, the states follow
/// the parameters by Φ Δw, and the stated σ is widened to the spread of the innovations. The filter assumes
/// white innovations. Hysteresis or stiction, which the model does not contain, correlates them within blocks
/// of kCorrelationBlock; then the scores g = Hᵀ R⁻¹ ν of blocks vary more than their information I states. σ
/// is multiplied by that ratio over the recent minute, or by the increase that the transient forces of
/// ModelDiscrepancy would cause, whichever is larger. (Only the batch method includes the persistent force,
/// hysteresis.)
///
/// `sink`, if given, receives every point of the trace at once.
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
