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

/// One column of numbers per joint or axis, one number per row: columns[joint][row]. Empty: not measured.
using Columns = std::vector<std::vector<double>>;

/// Recorded signal that drives the simulation: motor positions (cable) or motor torques (rigid).
using DriveKind = robot::DriveType;

/// Resolution and noise of one channel, estimated from its own samples (channel_noise.h).
struct ChannelNoise {
  double step = 0.0;   ///< quantisation step; 0: no quantisation found
  double sigma = 0.0;  ///< standard deviation of the white noise, quantisation included
  /// Noise floor: the larger of sigma and of the standard deviation of rounding, step/√12.
  double floor() const;
};

/// Noise of all channels of one recording.
struct EvidenceNoise {
  std::vector<ChannelNoise> q_m, dq_m, tau_m, tau_ext, q;  ///< one entry per joint; empty: not measured
  std::array<ChannelNoise, 3> tip;  ///< one entry per axis of frame 0; zero without cameras
};

/// One camera measurement of the tip position.
struct TipObservation {
  double t = 0.0;    ///< stamp of the exposure, on the cameras' clock [s]
  double row = 0.0;  ///< position among the rows: 3.25 is a quarter of a step after row 3
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< frame 0 [m]
  bool counts = true;  ///< false: an outlier, or a row beside it does not count
};

/// Rows [begin, end) with a constant time step. The simulation of the recording restarts at each segment,
/// because the input between segments is not known.
struct Segment {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

/// Reason why a row is excluded from the comparison of measurement and simulation; bits of
/// Evidence::exclusions.
enum ExclusionReason : std::uint8_t {
  kGap = 1,        ///< the input was interpolated over missing rows
  kSaturated = 2,  ///< a motor encoder stands at its end, or the torque exceeds the motor's limit
  kStart = 4,      ///< within EvidenceOptions::skip_start of the recording's start
};

/// One recording as diagnosis uses it: numbers in SI on rows with a constant time step, n joints (1–7).
struct Evidence {
  std::string title;  ///< file name, or the session's title
  std::string file;   ///< path of the file, for error messages; empty: no file
  DriveKind drive = DriveKind::kCable;
  int joints = 0;
  double step = 0.0;                     ///< time between the rows of a segment [s]
  std::vector<double> t;                 ///< times, rising [s]; row k of a segment is at t[begin] + k step
  std::vector<Segment> segments;         ///< in order of time; together they hold all rows
  Columns q_m;                           ///< motor position from the hard stop [rad]
  Columns dq_m;                          ///< motor velocity [rad/s]; given wherever q_m is given
  Columns tau_m;                         ///< motor torque (or force) [N·m or N]
  Columns tau_ext;                       ///< external load, positive towards positive q [N·m or N]
  Columns q;                             ///< joint encoders [rad or m]; NaN in rows without a reading
  std::vector<TipObservation> tip;       ///< camera measurements in order of time, within the segments
  std::vector<std::uint8_t> exclusions;  ///< bits of ExclusionReason, one entry per row; 0: the row counts
  EvidenceNoise noise;
  std::optional<robot::Description> robot;  ///< nominal robot, if the recording contains one
  std::vector<std::string> notices;         ///< exclusions and remarks for the user, one line each

  std::size_t rows() const { return t.size(); }
  bool counts(std::size_t row) const { return exclusions[row] == 0; }
  std::size_t countingRows() const;
  std::size_t countingObservations() const;
  bool hasEncoders() const { return !q.empty(); }
  bool hasCameras() const { return !tip.empty(); }
  /// Duration of all segments together [s].
  double duration() const;
  /// Value of a column between rows, by linear interpolation; `row` as TipObservation::row, in one segment.
  static double at(const std::vector<double>& column, double row);
};

struct EvidenceOptions {
  double skip_start = 0.0;         ///< time at the recording's start, simulated but not compared [s]
  recording::ReadAs read_as = {};  ///< units of a measured table
};

/// Fewest counting rows, and fewest tip observations where there are no encoders, that a diagnosis needs.
inline constexpr std::size_t kFewestRows = 100;
inline constexpr std::size_t kFewestObservations = 20;

}  // namespace capstan::diagnosis
