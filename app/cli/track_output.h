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

/// What the errors of a recording are taken against: "joint encoders", "own kinematics" (which is no truth),
/// "none".
const char* referenceOf(const tracking::SourceInfo& info);

/// Whether the mean NIS of accepted camera samples, by its degrees of freedom, is what chance makes of a
/// consistent filter.
struct NisVerdict {
  double mean = 0.0;
  estimation::Band band;  ///< of the mean, 95 %
  bool passed() const { return band.contains(mean); }
  estimation::NisVerdict verdict() const { return estimation::judgeNis(mean, passed()); }
  /// "pass", "cautious" or "FAIL, too high".
  std::string text() const { return std::string(base::nameOf(verdict())); }
  /// What it says where it is no pass, and what to do; empty: it passed.
  std::string advice() const { return std::string(estimation::adviceOf(verdict())); }
};
/// Empty: no camera sample was accepted.
std::optional<NisVerdict> nisVerdict(const tracking::TrackReport& report);

/// The report for people: errors in deg, deg, mm; detection, gate, consistency; `seconds` of computing for
/// the speed.
std::string textOf(const tracking::TrackReport& report, const tracking::SourceInfo& info, double seconds);
/// The report in SI: {"rms": {"kin": […], "cam": […], "ukf": […]}, "nis": …, "nis_band": […],
/// "samples": …, "reference": …, …}. No times of
/// computing, so that the same input gives the same document.
nlohmann::json jsonOf(const tracking::TrackReport& report, const tracking::SourceInfo& info);

/// Writes one CSV row a motor sample and a camera sample: t, camera flag, t_cam, q_kin, q_cam, q_ukf, dq_ukf,
/// sigma, reference (of t, on rows of cameras of t_cam), gate, NIS; SI, 17 digits, empty where nothing is
/// known. A former file stays until the new one is whole.
class EstimateWriter {
 public:
  /// Throws base::InputError when `path` cannot be written. Empty path: writes nothing.
  explicit EstimateWriter(const std::filesystem::path& path);
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// Throws base::InputError when the disk took less than everything.
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
  std::optional<tracking::Snapshot> motor_row_;  ///< waits for the reference of its time
  Eigen::Vector3d reference_;
};

}  // namespace capstan::cli
