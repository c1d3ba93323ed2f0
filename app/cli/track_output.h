#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/base/part_file.h"
#include "core/estimation/consistency.h"
#include "core/estimation/nis_verdict.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

namespace capstan::cli {

/// Reference of a recording's errors: "joint encoders", "own kinematics" (not a true reference) or "none".
const char* referenceOf(const tracking::SourceInfo& info);

/// Test of the filter's consistency: the mean NIS of accepted camera samples by its degrees of freedom, and
/// its 95 % band.
struct NisVerdict {
  double mean = 0.0;
  estimation::Band band;  ///< 95 % band of the mean of a consistent filter
  bool passed() const { return band.contains(mean); }
  estimation::NisVerdict verdict() const { return estimation::judgeNis(mean, passed()); }
  /// "pass", "cautious" or "FAIL, too high".
  std::string text() const { return std::string(base::nameOf(verdict())); }
  /// Meaning of a verdict that is no pass, and the remedy; empty: it passed.
  std::string advice() const { return std::string(estimation::adviceOf(verdict())); }
};
/// Verdict of a report; empty if no camera sample was accepted.
std::optional<NisVerdict> nisVerdict(const tracking::TrackReport& report);

/// Text of a report for people: errors in deg, deg, mm; detection, gate, consistency. `seconds`: computing
/// time, for the speed; 0: not printed.
std::string textOf(const tracking::TrackReport& report, const tracking::SourceInfo& info, double seconds);
/// JSON of a report in SI: {"rms": {"kin": […], "cam": […], "ukf": […]}, "nis": …, "nis_band": […],
/// "samples": …, "reference": …, …}. It has no computing times, so that the same input gives the same
/// document.
nlohmann::json jsonOf(const tracking::TrackReport& report, const tracking::SourceInfo& info);

/// Writer of estimates as CSV, one row per motor sample and per camera sample: t, camera flag, t_cam, q_kin,
/// q_cam, q_ukf, dq_ukf, sigma, reference (at t; on rows of camera samples at t_cam), gate, NIS. SI, 17
/// digits; unknown values are empty. A former file stays until the new one is complete.
class EstimateWriter {
 public:
  /// Opens `path`; an empty path writes nothing. Throws base::InputError when it cannot be written.
  explicit EstimateWriter(const std::filesystem::path& path);
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// Completes the file. Throws base::InputError when not everything could be written.
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void flush();
  void write(const tracking::Snapshot& snapshot, const Eigen::Vector3d& reference);

  std::filesystem::path path_;
  std::optional<base::PartFile> part_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::optional<tracking::Snapshot> motor_row_;  ///< motor row that waits for the reference of its time
  Eigen::Vector3d reference_;
};

}  // namespace capstan::cli
