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

/// A recording is one SQLite 3 file with the suffix `.capstan`. It has numeric columns in SI, their units and
/// meanings in the table `dictionary`, and frames as lossless BLOBs. `seq` of a row is its index in the order
/// of arrival over all tables. A quantity that does not exist (NaN) is NULL. schema.h lists tables and
/// columns.
namespace capstan::recording {

inline constexpr const char* kSessionSuffix = ".capstan";

/// Header of a session file. Texts are contents of complete files.
struct SessionHeader {
  std::string title;
  std::string created;      ///< creation time, ISO 8601, from the caller
  std::string software;     ///< name and version that wrote the file
  std::string robot;        ///< robot file (YAML)
  std::string camera_left;  ///< ROS camera_info (YAML); empty: no images
  std::string camera_right;
  std::string truth;     ///< truth file (YAML) of a simulation, else empty
  std::string marker;    ///< marker options (YAML), else empty
  std::string tracking;  ///< tracking options (YAML), else empty
  std::optional<Eigen::Isometry3d> base_from_camera;
  std::string
      rows;  ///< numbers of rows, textOf(RowCounts); empty: not written, because the recording did not end
  bool reference = false;       ///< the robot has joint encoders
  bool own_kinematics = false;  ///< joints are the robot's own kinematics instead
};

/// Header of a recording of `source` that starts now.
SessionHeader headerOf(const tracking::SourceInfo& source, std::string created);

/// An event at t [s]: occlusion, registration, a user's note.
struct SessionEvent {
  double t = 0.0;
  /// "occlusion", "registration", "note", "source", "camera", "robot", "recorder", "session" (a pause)
  std::string kind;
  std::string text;
};

/// One row of table `estimate`: output of the pipeline at t [s]. Joints in rad, rad, m; NaN: none.
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

/// Summary of a session file, for lists and for `capstan-cli info`.
struct SessionSummary {
  SessionHeader header;
  double first_t = 0.0, last_t = 0.0;  ///< time of the first and last sample of all tables [s]; 0: none
  std::int64_t motor = 0, joint = 0, tip = 0, frames = 0, estimates = 0, events = 0;
  std::uint64_t bytes = 0;    ///< size of the file and its write-ahead log
  int width = 0, height = 0;  ///< size of the frames [px]; 0: none
};

/// Reads header and counts. Throws base::InputError with the remedy for a file that is missing, not a
/// session, damaged, or of a newer version.
SessionSummary readSessionSummary(const std::filesystem::path& path);
/// All events or all estimates, in order of arrival.
std::vector<SessionEvent> readSessionEvents(const std::filesystem::path& path);
std::vector<EstimateRow> readSessionEstimates(const std::filesystem::path& path);

}  // namespace capstan::recording
