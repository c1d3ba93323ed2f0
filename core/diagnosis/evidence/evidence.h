#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/recording/column_units.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// One number a row for each joint (or axis): columns[joint][row]. Empty: there is none of it.
using Columns = std::vector<std::vector<double>>;

using DriveKind = robot::DriveType;  ///< what drives the simulation

/// What a channel cannot distinguish, estimated from its own samples (channel_noise.h).
struct ChannelNoise {
  double step = 0.0;   ///< quantisation: the smallest step that shows; 0: none shows
  double sigma = 0.0;  ///< standard deviation of its white noise, quantisation in it
  /// The larger of sigma and of a uniform rounding error, step/√12.
  double floor() const;
};

struct EvidenceNoise {
  std::vector<ChannelNoise> q_m, dq_m, tau_m, tau_ext, q;  ///< a joint each; empty: not measured
  std::array<ChannelNoise, 3> tip;                         ///< axes of frame 0; zero without cameras
};

/// Where the cameras saw the tip, at an instant of their own clock.
struct TipObservation {
  double t = 0.0;    ///< stamp of the exposure [s]
  double row = 0.0;  ///< place among the rows: 3.25 is a quarter after row 3
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< frame 0 [m]
  bool counts = true;                                  ///< false: an outlier, or its rows do not count
};

/// Rows [begin, end) an even step apart. Between segments the drive is not known: simulations restart.
struct Segment {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

/// Why a row does not count in what measured and simulated are compared by; bits of Evidence::exclusions.
enum ExclusionReason : std::uint8_t {
  kGap = 1,        ///< the drive was interpolated over rows that are missing
  kSaturated = 2,  ///< an encoder stands at its end, or the commanded torque is beyond the motor's
  kStart = 4,      ///< within EvidenceOptions::skip_start of the begin
};

/// One recording as diagnosis sees it: plain numbers on an even grid, SI, n joints (1–7).
struct Evidence {
  std::string title;  ///< file name, or the session's title
  std::string file;   ///< for error messages; empty: none
  DriveKind drive = DriveKind::kCable;
  int joints = 0;
  double step = 0.0;                     ///< between rows of a segment [s]
  std::vector<double> t;                 ///< rising [s]; within a segment t[begin] + k step
  std::vector<Segment> segments;         ///< in order, together all rows
  Columns q_m;                           ///< motor position from the hard stop [rad]
  Columns dq_m;                          ///< motor velocity [rad/s]; there wherever q_m is
  Columns tau_m;                         ///< motor torque (or force) [N·m or N]
  Columns tau_ext;                       ///< load that pushes towards positive q [N·m or N]
  Columns q;                             ///< joint encoders [rad or m]; NaN in rows where none was read
  std::vector<TipObservation> tip;       ///< in order of time, within the segments
  std::vector<std::uint8_t> exclusions;  ///< a row each; 0: it counts
  EvidenceNoise noise;
  std::optional<robot::Description> robot;  ///< nominal, where the recording brings one
  std::vector<std::string> notices;         ///< exclusions and remarks for the user, a line each

  std::size_t rows() const { return t.size(); }
  bool counts(std::size_t row) const { return exclusions[row] == 0; }
  std::size_t countingRows() const;
  std::size_t countingObservations() const;
  bool hasEncoders() const { return !q.empty(); }
  bool hasCameras() const { return !tip.empty(); }
  /// Of the segments together [s].
  double duration() const;
  /// Column value between rows, linear; `row` as TipObservation::row, within one segment.
  static double at(const std::vector<double>& column, double row);
};

struct EvidenceOptions {
  std::optional<DriveKind> drive;              ///< none: the robot file's
  double step = 0.0;                           ///< of the grid [s]; 0: the recording's own
  double skip_start = 0.0;                     ///< at the recording's begin, simulated but not compared [s]
  static constexpr double kLongestGap = 0.05;  ///< missing rows that the drive is interpolated over; longer
                                               ///< ones part segments [s]; at least three steps
  double smoothing = 0.01;  ///< half width of the window that dq_m is differentiated in, where no velocity
                            ///< was measured [s]
  recording::ReadAs read_as = {};  ///< units of a measured table
};

/// Fewest rows that count (or tip observations, where there are no encoders) for anything to be said.
inline constexpr std::size_t kFewestRows = 100;
inline constexpr std::size_t kFewestObservations = 20;

}  // namespace capstan::diagnosis
