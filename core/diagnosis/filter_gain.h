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

/// Robots with which the same filter runs.
struct FilterRobots {
  robot::Description nominal, refitted, extended;
};

struct FilterGainOptions {
  int threads = 2;                  ///< number of worker threads
  bool zero_per_recording = false;  ///< true: subtract each recording's mean error (free encoder zeros)
  bool one_kernel = true;           ///< true: robots without effects run in the kernel of robots with effects
  /// Options of the filter; camera_period is taken from the recording's tips. The six-state filter is used
  /// because the augmented filter itself compensates part of the effects that a diagnosis explains.
  tracking::TrackingOptions tracking = tracking::sixState();
};

/// Result of filterGain().
struct FilterGainReport {
  std::vector<FilterGain> joints;    ///< one entry per joint; empty: no recording can be used
  std::vector<std::string> notices;  ///< excluded recordings, and the reasons; estimates that become worse
  bool cancelled = false;
};

/// RMS errors of the square-root UKF (tracking::TrackingPipeline) with each robot, against the joint
/// encoders:
///     RMS_j = √(Σ (q_j,ukf − q_j,encoder)² / n) [rad or m],
/// over all rows that count and have an encoder reading. The filter gets motor samples and tip observations
/// in order of time, each observation at its stamp; if a robot's cameras stamp before the exposure
/// (camera_latency below 0), observations come later by that time for all robots. The estimate of a row uses
/// no later data. The encoders are the reference and never an input. Process noise is the same for all three
/// robots and represents the errors of the nominal model: if it is large, a contact law such as backlash
/// lowers the error little.
///
/// The filter has two kernels, one for the nominal law and one for laws with effects. They differ in the time
/// step and in the use of motor velocity, which changes the RMS even at joints without effects. With
/// `one_kernel` all robots run in the same kernel, so that this change does not appear in the result. Without
/// it, the RMS is that of tracking with each robot.
///
/// For cable-driven remote-centre arms of three joints. Recordings without joint encoders or cameras are
/// excluded, with a notice each; a notice gives the reason if the filter cannot run with this robot. The
/// result does not depend on the number of threads. Throws nothing of its own.
FilterGainReport filterGain(const std::vector<Evidence>& recordings, const FilterRobots& robots,
                            const FilterGainOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
