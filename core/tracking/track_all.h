#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <optional>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/tracking/error_table.h"
#include "core/tracking/innovation_record.h"
#include "core/tracking/latency_counts.h"
#include "core/tracking/pipeline.h"

namespace capstan::tracking {

/// What restarted a report during a session. kBeginning: nothing, it covers the whole session so far.
enum class ReportStart : std::uint8_t { kBeginning, kReset, kRegistration, kRobot, kFilterOptions, kCameras };

/// Result of a TrackingPipeline on a whole recording.
struct TrackReport {
  ErrorTable errors;
  std::uint64_t motor_samples = 0;
  std::uint64_t camera_samples = 0;            ///< number of frames and tip samples
  std::array<std::uint64_t, 10> gates{};       ///< number of camera samples by Gate
  std::uint64_t frames = 0;                    ///< number of camera samples with images
  std::array<std::uint64_t, 2> blocked{};      ///< number of frames whose view was blocked deliberately
  std::array<std::uint64_t, 2> detected{};     ///< number of the other frames with a marker: left, right
  std::array<std::uint64_t, 2> wrong_image{};  ///< of another size or format than the calibration
  std::array<std::uint64_t, 2> full_frame{};   ///< number of `detected` found by the full-frame search
  double first_t = 0.0, last_t = 0.0;          ///< time of the first and last motor sample [s]
  double nis_sum = 0.0;                        ///< sum of NIS over accepted camera samples
  std::uint64_t rays = 0;                      ///< updates with the ray of one camera
  double ray_nis_sum = 0.0;                    ///< sum of their NIS
  double nees_sum = 0.0;                       ///< sum of NEES over paired references
  std::uint64_t nees_count = 0;
  InnovationRecord innovations;  ///< of accepted camera samples
  LatencyCounts latencies;       ///< of camera samples
  std::uint64_t rescues = 0, late_dropped = 0;
  std::uint64_t motor_refused = 0;  ///< motor samples that were not finite or not later than the one before
  std::uint64_t motor_stray = 0;    ///< motor samples with a position that no arm can have (StrayReadings)
  bool live_cameras = false;        ///< a live source with cameras, noteSource(); else false
  bool own_kinematics = false;      ///< the errors are differences from the robot's own kinematics
  ReportStart since = ReportStart::kBeginning;
  std::uint64_t lost = 0;  ///< samples that a live source lost or dropped, noteSource(); else 0
  std::string refusal;     ///< why a live source refused data last, noteSource(); empty: never
  std::array<MotorFault, 3> motor_failed{};    ///< failed encoders at the end
  std::array<double, 3> motor_failed_since{};  ///< time of detection or declaration [s]
  TransmissionEstimate transmission;           ///< estimate of the augmented filter at the end
  bool cancelled = false;

  /// Adds a snapshot. Counts start at the first snapshot, independent of earlier counts of the pipeline.
  void add(const Snapshot& snapshot);
  /// Begins again: what was before `start` is of other assumptions. Without samples it keeps its own
  /// beginning.
  void restart(ReportStart start);
  double gateShare(Gate gate) const;  ///< share of camera samples; NaN without any
  /// Number of frames whose view was not blocked deliberately, and the share of them with a marker (NaN:
  /// there are none); 0 left, 1 right.
  std::uint64_t unblocked(int side) const;
  double detectionRate(int side) const;
  double nisMean() const;  ///< mean NIS of accepted camera samples over its 3 degrees of freedom; NaN: none
  double rayNisMean() const;  ///< mean NIS of the ray updates over their 2 degrees of freedom; NaN: none
  double neesMean() const;    ///< mean position NEES over its 3 degrees of freedom; NaN: no true reference

 private:
  /// Computes the increase of a running total of the pipeline from snapshot to snapshot.
  struct Rise {
    std::optional<std::uint64_t> before;
    std::uint64_t to(std::uint64_t total) {
      const std::uint64_t from = std::min(before.value_or(total), total);
      before = total;
      return total - from;
    }
  };
  Rise rescue_rise_, late_rise_, refused_rise_, stray_rise_;
};

template <class T>
concept SampleSource = requires(T& source, Sample& sample) {
  { source.next(sample) } -> std::convertible_to<bool>;
};

struct IgnoreSnapshots {
  void operator()(const Sample&, const Snapshot&) const {}
};

/// Waits until a real-time source has a sample, and calls each.waiting(), if it exists, when none comes at
/// once. False: `cancelled` meanwhile.
template <SampleSource Source, class Each>
bool waitFor(Source& source, const auto& cancelled, Each& each) {
  constexpr std::chrono::milliseconds kAtOnce{2}, kPatience{100};
  if constexpr (requires { source.ready(kPatience); }) {
    if constexpr (requires { each.waiting(); }) {
      if (source.ready(kAtOnce)) return true;
      each.waiting();
    }
    while (!source.ready(kPatience))
      if (cancelled()) return false;
  }
  return true;
}

/// Runs `pipeline` over all of `source` and calls `each(sample, snapshot)` after every step. `duration` [s]
/// from the first sample to the last (0: unknown) scales the progress. Cancellable; the report then covers
/// the samples before the cancellation.
template <SampleSource Source, class Each = IgnoreSnapshots>
TrackReport trackAll(Source& source, TrackingPipeline& pipeline, base::Progress* progress = nullptr,
                     double duration = 0.0, Each each = {}) {
  TrackReport report;
  Sample sample;
  const auto cancelled = [&] { return report.cancelled = progress && progress->cancelled(); };
  if (!waitFor(source, cancelled, each)) return report;
  for (std::uint64_t count = 0; source.next(sample); ++count) {
    const Snapshot& snapshot = pipeline.step(sample);
    report.add(snapshot);
    each(static_cast<const Sample&>(sample), snapshot);
    if (count % 256 == 0) {
      if (cancelled()) break;
      if (progress && duration > 0.0)
        progress->report(std::min(1.0, (report.last_t - report.first_t) / duration), "tracking");
    }
    if (!waitFor(source, cancelled, each)) break;
  }
  return report;
}

}  // namespace capstan::tracking

template <>
struct capstan::base::NamesOf<capstan::tracking::ReportStart> {
  using R = capstan::tracking::ReportStart;
  static constexpr std::array value = {std::pair{R::kBeginning, "the beginning"},
                                       std::pair{R::kReset, "the reset"},
                                       std::pair{R::kRegistration, "the registration"},
                                       std::pair{R::kRobot, "the new robot"},
                                       std::pair{R::kFilterOptions, "the new filter options"},
                                       std::pair{R::kCameras, "the new cameras"}};
};
