#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/report/report.h"
#include "core/robot/description.h"
#include "core/tracking/options.h"

namespace capstan::diagnosis {

/// What three robot files make of the same filter.
struct FilterRobots {
  robot::Description nominal, refitted, extended;
};

struct FilterGainOptions {
  int threads = 2;
  bool zero_per_recording = false;  ///< errors about their mean in each recording: its encoders' zero is free
  bool one_kernel = true;           ///< robots without effects run in the kernel that those with effects need
  /// camera_period is taken from the tips. Of the six-state filter: the augmented one takes up part of what a
  /// diagnosis explains.
  tracking::TrackingOptions tracking = tracking::sixState();
};

struct FilterGainReport {
  std::vector<FilterGain> joints;    ///< empty: nothing to measure it on
  std::vector<std::string> notices;  ///< what was excluded, and why
  bool cancelled = false;
};

/// Runs the square-root UKF (tracking::TrackingPipeline) with each robot over the motors and the tip
/// observations of the recordings, in order of time: an observation is known at its own instant, one that a
/// robot's cameras stamp before its exposure (camera_latency below 0) only then. RMS_j = √(Σ (q_j,ukf −
/// q_j,encoder)² / n) [rad or m] over the rows of all recordings that count and in which the encoder was
/// read; the estimate of a row uses nothing later. Process noise is the same for all three, and stands for
/// what the nominal model does not know: with much of it, a law with contacts (backlash) gains little. The
/// encoders are the reference, never an input.
///
/// The filter has two kernels, of the nominal law and of laws with effects, which cut time and read motor
/// velocity differently; that alone changes RMS at joints without effects. With `one_kernel` it does not
/// count as a gain; without, the numbers are those that tracking with each robot file gives.
///
/// For cable-driven remote-centre arms of three joints. Recordings without joint encoders or cameras are left
/// out; notices name them, and say why there is nothing where nothing remains. The same numbers whatever the
/// threads. Throws nothing of its own.
FilterGainReport filterGain(const std::vector<Evidence>& recordings, const FilterRobots& robots,
                            const FilterGainOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
