#pragma once

#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/base/table.h"
#include "core/robot/description.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

namespace capstan::tracking {

/// Verdict on the estimator or on one quantity of it, from good to bad; kUnknown: nothing to judge yet.
enum class HealthVerdict { kUnknown, kPass, kCautious, kFail };

/// Limits of the verdicts: pass up to the first number, fail beyond the second. `capstan-cli study health`
/// measures how often they call a correct filter wrong and miss a wrong one.
struct HealthLimits {
  /// Mean NIS of a joint. Above: the σ of the filter are too small, by the root. Below nis_low they are too
  /// large, which wastes measurements but misleads nobody: cautious, never a failure.
  double nis_low = 0.2, nis = 2.5, nis_fail = 4.0;
  double nees = 2.0, nees_fail = 6.0;              ///< mean NEES over its degrees of freedom
  double undetected = 0.2, undetected_fail = 0.9;  ///< share of images without the marker
  double refused = 0.01, refused_fail = 0.1;       ///< share of camera samples that the gate refused
  double latency = 0.5, latency_fail = 1.0;        ///< 99 % latency over the filter's memory
  double rescues = 0.0, rescues_fail = 1e-3;       ///< repaired covariances per sample
  double lost = 0.0, lost_fail = 1e-3;             ///< lost, dropped and refused samples per sample
  double no_images = 2.0;              ///< a session without a used image is judged from this length on [s]
  std::uint64_t updates = 300;         ///< camera updates before NIS is judged: 20 s at 15 per second
  std::uint64_t recent_updates = 150;  ///< newest ones, whose NIS above nis_fail fails as that of all does
};

/// One judged quantity.
struct HealthCheck {
  std::string key = {};   ///< name for programs: nis_q1 … lost
  std::string name = {};  ///< name for people
  HealthVerdict verdict = HealthVerdict::kUnknown;
  std::string value = {};     ///< measured value with unit, and why it is not judged; empty: none yet
  std::string expected = {};  ///< what passes
  std::string advice = {};    ///< meaning and remedy, in sentences; empty where it passes
};

/// Number of samples that the sides of a live source lost or dropped.
std::uint64_t lostOf(const std::vector<SideStatus>& sides);
/// Notes in `report` what only its source knows: whether it is live with cameras, and what it lost.
void noteSource(const SourceInfo& info, const std::vector<SideStatus>& sides, TrackReport& report);

/// Checks of the estimator that ran over `report`: NIS of every joint, NEES (with a reference), errors of the
/// transmission, use of the cameras (of a live session, and where no image was used), detection rates,
/// refused camera samples, latency, rescues, encoders, lost samples. `memory` is TrackingOptions::memory [s].
/// Checks of images and of the reference are left out where there are none.
std::vector<HealthCheck> healthOf(const TrackReport& report, const robot::Description& robot, double memory,
                                  const HealthLimits& limits = {});

/// The checks of NIS, one per joint.
std::vector<HealthCheck> nisChecksOf(const std::vector<HealthCheck>& checks);

/// The worst verdict of the checks; kUnknown only if nothing was judged.
HealthVerdict worstOf(const std::vector<HealthCheck>& checks);

/// The checks as a table: check, verdict, value, expected, advice.
base::Table healthTable(const std::vector<HealthCheck>& checks);

}  // namespace capstan::tracking

template <>
struct capstan::base::NamesOf<capstan::tracking::HealthVerdict> {
  using V = capstan::tracking::HealthVerdict;
  static constexpr std::array value = {std::pair{V::kUnknown, "unknown"}, std::pair{V::kPass, "pass"},
                                       std::pair{V::kCautious, "cautious"}, std::pair{V::kFail, "FAIL"}};
};
