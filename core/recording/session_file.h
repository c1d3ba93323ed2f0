#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"

/// One recording is one SQLite 3 file, suffix `.capstan`: plain numeric columns in SI, their units and
/// meanings in the table `dictionary`, frames as lossless BLOBs. Every row's `seq` is its place in the order
/// of arrival, across tables. A quantity that does not exist (NaN) is NULL. schema.h lists tables and
/// columns.
namespace capstan::recording {

inline constexpr const char* kSessionSuffix = ".capstan";

/// What a session file says before its first sample. Texts are whole files, as their readers take them.
struct SessionHeader {
  std::string title;
  std::string created;      ///< ISO 8601, given by the caller
  std::string software;     ///< name and version that wrote the file
  std::string robot;        ///< robot file (YAML)
  std::string camera_left;  ///< ROS camera_info (YAML); empty: no images
  std::string camera_right;
  std::string truth;     ///< truth file of a simulation, else empty
  std::string marker;    ///< marker options (YAML), else empty
  std::string tracking;  ///< tracking options (YAML), else empty
  std::optional<Eigen::Isometry3d> base_from_camera;
  bool reference = false;       ///< joint encoders fitted
  bool own_kinematics = false;  ///< in their place: the robot's own kinematics
};

/// The header of a recording of `source`, now.
SessionHeader headerOf(const tracking::SourceInfo& source, std::string created);

/// Something that happened at t: occlusion, registration, a user's note.
struct SessionEvent {
  double t = 0.0;
  std::string kind;  ///< "occlusion", "registration", "note", "recorder"
  std::string text;
};

/// One row of table `estimate`: what the pipeline said at t. Joints as rad, rad, m; NaN: none.
struct EstimateRow {
  double t = 0.0;
  double t_cam = 0.0;
  Eigen::Vector3d q_link_kin, q_link_cam, q_link_cam_sigma, q_link_ukf, dq_link_ukf, q_link_ukf_sigma,
      q_link_true;
  int gate = 0;  ///< tracking::Gate
  bool camera_updated = false;
  double nis = 0.0, nees = 0.0;
};
EstimateRow estimateOf(const tracking::Snapshot& snapshot);

/// What a session file holds, for lists and for `capstan-cli info`.
struct SessionSummary {
  SessionHeader header;
  double first_t = 0.0, last_t = 0.0;  ///< over all samples [s]; 0: none
  std::int64_t motor = 0, joint = 0, tip = 0, frames = 0, estimates = 0, events = 0;
  std::uint64_t bytes = 0;    ///< the file and its write-ahead log
  int width = 0, height = 0;  ///< of the frames [px]; 0: none
};

/// Reads header and counts. Throws base::InputError with the remedy for a file that is missing, not a
/// session, damaged, or written by a newer version.
SessionSummary readSessionSummary(const std::filesystem::path& path);
/// All events and all estimates, in order.
std::vector<SessionEvent> readSessionEvents(const std::filesystem::path& path);
std::vector<EstimateRow> readSessionEstimates(const std::filesystem::path& path);

}  // namespace capstan::recording
