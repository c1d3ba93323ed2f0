#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/diagnosis/evidence/channel_noise.h"
#include "core/diagnosis/evidence/even_grid.h"
#include "core/diagnosis/evidence/recorded_tracks.h"
#include "core/diagnosis/evidence/smooth_derivative.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

constexpr std::size_t kFewestPieceRows = 5;
constexpr double kLongestGap = 0.05;  // longest gap that the input is interpolated over [s]: longer ones end
                                      // a segment, if they are also longer than 3.5 periods
constexpr double kSmoothing = 0.01;   // half width of the window that q_m is differentiated in [s]

[[noreturn]] void refuse(const RecordedTracks& tracks, std::string column, std::string value,
                         std::string reason, std::string remedy) {
  throw base::InputError(
      {tracks.file, 0, std::move(column), std::move(value), std::move(reason), std::move(remedy)});
}

void checkJoints(const RecordedTracks& tracks, const robot::Description& robot) {
  const auto n = static_cast<std::size_t>(robot.size());
  const std::pair<const char*, const Columns*> quantities[] = {{"q_m", &tracks.q_m},
                                                               {"dq_m", &tracks.dq_m},
                                                               {"tau_m", &tracks.tau_m},
                                                               {"q", &tracks.q},
                                                               {"tau_ext", &tracks.tau_ext}};
  for (const auto& [name, columns] : quantities)
    if (!columns->empty() && columns->size() != n)
      refuse(tracks, fmt::format("{}{}", name, columns->size()), fmt::format("{} of them", columns->size()),
             fmt::format("but the robot file {} has {} joint{}", robot.name, n, n == 1 ? "" : "s"),
             "Give the robot file that the recording was made with, or columns for each of its joints");
}

void checkSensors(const RecordedTracks& tracks, DriveKind drive) {
  if (drive == DriveKind::kCable && tracks.q_m.empty())
    refuse(tracks, "q_m1", {}, "is missing: motor positions drive the simulation of a cable-driven robot",
           "Add the motor encoders [rad, from the hard stop] as columns q_m1 …, or give a robot file whose "
           "drive is rigid");
  if (drive == DriveKind::kRigid && tracks.tau_m.empty())
    refuse(tracks, "tau_m1", {}, "is missing: motor torques drive the simulation of a rigid robot",
           "Add the motor torques (or forces) [N*m or N] as columns tau_m1 …");
  if (tracks.q.empty() && tracks.tip.empty())
    refuse(tracks, "q1, p_c1", {},
           tracks.own_kinematics
               ? "are missing: neither joint encoders nor cameras measured the motion (the joint "
                 "positions are those that the robot computed from its motors)"
               : "are missing: neither joint encoders nor cameras measured the motion",
           "Add joint encoders [rad or m] as q1 … or the tip seen by cameras [m] as p_c1, p_c2, p_c3");
}

/// Times of the rows in which every joint has its input.
std::vector<double> drivenTimes(const RecordedTracks& tracks, const Columns& drive) {
  std::vector<double> times;
  for (std::size_t i = 0; i < tracks.t.size(); ++i)
    if (std::all_of(drive.begin(), drive.end(),
                    [i](const std::vector<double>& column) { return std::isfinite(column[i]); }))
      times.push_back(tracks.t[i]);
  return times;
}

/// Channels on the rows of the grid, and their noise, estimated from their own samples.
struct Placed {
  Columns columns;
  std::vector<ChannelNoise> noise;
};

Placed placeDrive(const EvenGrid& grid, const std::vector<double>& t, const Columns& columns, double reach,
                  std::vector<std::uint8_t>* interpolated) {
  Placed placed;
  for (const std::vector<double>& column : columns) {
    const Track track = trackOf(t, column);
    placed.columns.push_back(interpolateTo(grid, track, reach, interpolated));
    placed.noise.push_back(channelNoise(track.x));
  }
  return placed;
}

Placed placeReference(const EvenGrid& grid, const RecordedTracks& tracks) {
  Placed placed;
  for (const std::vector<double>& column : tracks.q) {
    const Track track = trackOf(tracks.t_q, column);
    std::vector<double> rows = placeOn(grid, track);
    const ChannelNoise noise = channelNoise(track.x);
    const std::vector<std::uint8_t> stands = standsAtEnd(rows, grid.segments, noise.floor());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (stands[i]) rows[i] = base::kNaN;
    placed.columns.push_back(std::move(rows));
    placed.noise.push_back(noise);
  }
  return placed;
}

/// Fills in motor velocities that were not measured, segment by segment.
void differentiate(Evidence& evidence) {
  const auto half =
      std::max<std::size_t>(3, static_cast<std::size_t>(std::lround(kSmoothing / evidence.step)));
  evidence.dq_m.resize(evidence.q_m.size(), std::vector<double>(evidence.rows(), base::kNaN));
  for (std::size_t j = 0; j < evidence.q_m.size(); ++j)
    for (const Segment& segment : evidence.segments) {
      const auto given = std::span(evidence.dq_m[j]).subspan(segment.begin, segment.size());
      if (std::all_of(given.begin(), given.end(), [](double v) { return std::isfinite(v); })) continue;
      const std::vector<double> slope = smoothDerivative(
          std::span(evidence.q_m[j]).subspan(segment.begin, segment.size()), evidence.step, half);
      for (std::size_t i = 0; i < slope.size(); ++i)
        if (!std::isfinite(given[i])) given[i] = slope[i];
    }
}

void mark(std::vector<std::uint8_t>& exclusions, const std::vector<std::uint8_t>& where,
          ExclusionReason reason) {
  for (std::size_t i = 0; i < where.size(); ++i)
    if (where[i]) exclusions[i] |= reason;
}

void markSaturated(Evidence& evidence, const robot::Description& robot) {
  if (evidence.drive == DriveKind::kCable)
    for (std::size_t j = 0; j < evidence.q_m.size(); ++j)
      mark(evidence.exclusions,
           standsAtEnd(evidence.q_m[j], evidence.segments, evidence.noise.q_m[j].floor()), kSaturated);
  if (evidence.drive == DriveKind::kRigid && robot.drives.size() == evidence.tau_m.size())
    for (std::size_t j = 0; j < evidence.tau_m.size(); ++j) {
      const double most = robot.drives[j].motor_torque_limit * (1.0 + 1e-6);
      for (std::size_t i = 0; i < evidence.rows() && most > 0.0; ++i)
        if (std::abs(evidence.tau_m[j][i]) > most) evidence.exclusions[i] |= kSaturated;
    }
}

void placeObservations(Evidence& evidence, const EvenGrid& grid, const RecordedTracks& tracks,
                       const robot::Description& robot) {
  for (std::size_t i = 0; i < tracks.tip.size(); ++i) {
    const double row = tracks.tip[i].allFinite() ? rowOf(grid, tracks.t_tip[i]) : -1.0;
    if (row >= 0.0) evidence.tip.push_back({tracks.t_tip[i], row, tracks.tip[i], true});
  }
  judgeObservations(evidence, robot);
  for (TipObservation& observation : evidence.tip) {
    const auto before = static_cast<std::size_t>(observation.row);
    const std::size_t after =
        std::min(before + (observation.row > static_cast<double>(before) ? 1 : 0), evidence.rows() - 1);
    if (!evidence.counts(before) || !evidence.counts(after)) observation.counts = false;
  }
}

/// Fills in missing loads, since a simulation needs a load in every row: the last reading is held, and the
/// row does not count. A joint without any reading has no load cell; its load is 0.
void fillLoads(Evidence& evidence) {
  for (std::vector<double>& load : evidence.tau_ext) {
    const auto first = std::find_if(load.begin(), load.end(), [](double x) { return std::isfinite(x); });
    double nearest = first == load.end() ? 0.0 : *first;
    for (std::size_t i = 0; i < load.size(); ++i) {
      if (!std::isfinite(load[i]) && first != load.end()) evidence.exclusions[i] |= kGap;
      if (std::isfinite(load[i])) nearest = load[i];
      load[i] = nearest;
    }
  }
}

/// The motor side and the joint encoders on the rows of the grid.
void placeChannels(Evidence& evidence, const EvenGrid& grid, const RecordedTracks& tracks) {
  const bool cable = evidence.drive == DriveKind::kCable;
  const double whole = 3.5 * grid.step, reach = std::max(kLongestGap, whole) * (1.0 + 1e-9);
  std::vector<std::uint8_t> missing;
  const auto place = [&](const Columns& columns, Columns& out, std::vector<ChannelNoise>& noise, double over,
                         bool drives) {
    Placed placed = placeDrive(grid, tracks.t, columns, over, drives ? &missing : nullptr);
    out = std::move(placed.columns), noise = std::move(placed.noise);
  };
  place(tracks.q_m, evidence.q_m, evidence.noise.q_m, reach, cable);
  place(tracks.dq_m, evidence.dq_m, evidence.noise.dq_m, whole, false);
  place(tracks.tau_m, evidence.tau_m, evidence.noise.tau_m, reach, !cable);
  place(tracks.tau_ext, evidence.tau_ext, evidence.noise.tau_ext, reach, false);
  Placed reference = placeReference(grid, tracks);
  evidence.q = std::move(reference.columns);
  evidence.noise.q = std::move(reference.noise);
  mark(evidence.exclusions, missing, kGap);
  fillLoads(evidence);
}

void noticeLosses(Evidence& evidence, const RecordedTracks& tracks) {
  if (evidence.segments.size() > 1)
    evidence.notices.push_back(
        fmt::format("{}: {} segments with gaps between them; each is simulated separately", evidence.title,
                    evidence.segments.size()));
  const auto share = [&](ExclusionReason reason) {
    const auto rows = std::count_if(evidence.exclusions.begin(), evidence.exclusions.end(),
                                    [&](std::uint8_t bits) { return (bits & reason) != 0; });
    return 100.0 * static_cast<double>(rows) / static_cast<double>(evidence.rows());
  };
  if (const double gaps = share(kGap); gaps > 0.0)
    evidence.notices.push_back(
        fmt::format("{}: {:.2g} % of the rows are missing and do not count", evidence.title, gaps));
  if (const double stuck = share(kSaturated); stuck > 0.0)
    evidence.notices.push_back(
        fmt::format("{}: {:.2g} % of the rows are saturated and do not count", evidence.title, stuck));
  const auto seen = static_cast<std::size_t>(std::count_if(
      tracks.tip.begin(), tracks.tip.end(), [](const Eigen::Vector3d& tip) { return tip.allFinite(); }));
  if (const std::size_t kept = evidence.countingObservations(); kept < seen)
    evidence.notices.push_back(
        fmt::format("{}: {} of {} tip observations do not count", evidence.title, seen - kept, seen));
}

/// Throws base::InputError if too few rows or observations count for a diagnosis.
void checkLength(const RecordedTracks& tracks, const Evidence& evidence) {
  if (evidence.countingRows() < kFewestRows)
    refuse(tracks, "t", fmt::format("{} rows", evidence.countingRows()),
           fmt::format("are fewer than the {} that diagnosis needs", kFewestRows),
           "Give a longer recording, or skip less of its start");
  std::size_t read = 0;
  for (const std::vector<double>& column : evidence.q)
    for (std::size_t i = 0; i < column.size(); ++i) read += evidence.counts(i) && std::isfinite(column[i]);
  if (read < kFewestRows && evidence.countingObservations() < kFewestObservations)
    refuse(tracks, evidence.hasEncoders() ? "q1" : "p_c1",
           fmt::format("{} readings, {} tip observations", read, evidence.countingObservations()),
           fmt::format("are fewer than the {} readings or {} observations that diagnosis needs", kFewestRows,
                       kFewestObservations),
           "Give a longer recording");
}

}  // namespace

std::vector<std::uint8_t> standsAtEnd(const std::vector<double>& column, const std::vector<Segment>& segments,
                                      double noise) {
  std::vector<std::uint8_t> stands(column.size(), 0);
  std::vector<std::size_t> rows;  // rows with a reading
  std::vector<double> jerks;      // |second difference| at each of them
  for (const Segment& segment : segments)
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      if (std::isfinite(column[i])) rows.push_back(i);
  if (rows.size() < kFewestPieceRows) return stands;
  const auto x = [&](std::size_t k) { return column[rows[k]]; };
  jerks.assign(rows.size(), 0.0);
  for (std::size_t k = 1; k + 1 < rows.size(); ++k) jerks[k] = std::abs(x(k + 1) - 2.0 * x(k) + x(k - 1));
  const double jerk = std::max(6.0 * noise, 3.0 * stats::quantile(jerks, 0.99));
  double low = x(0), high = x(0);
  for (std::size_t k = 0; k < rows.size(); ++k) low = std::min(low, x(k)), high = std::max(high, x(k));
  for (std::size_t begin = 0, end = 0; begin < rows.size() && low < high; begin = end) {
    for (end = begin + 1; end < rows.size() && x(end) == x(begin);) ++end;
    if (end - begin < kFewestPieceRows || (x(begin) != low && x(begin) != high)) continue;
    // The jerk is at the run's first sample, or one sample earlier if the end was reached between the two.
    const double at_entry = std::max(jerks[begin], begin > 0 ? jerks[begin - 1] : 0.0);
    const double at_exit = std::max(jerks[end - 1], end < rows.size() ? jerks[end] : 0.0);
    if (std::max(at_entry, at_exit) <= jerk) continue;
    for (std::size_t k = begin; k < end; ++k) stands[rows[k]] = 1;
  }
  return stands;
}

Evidence assembleEvidence(const RecordedTracks& tracks, const robot::Description& robot,
                          const EvidenceOptions& options) {
  checkSensors(tracks, robot.drive);
  checkJoints(tracks, robot);
  const Columns& input = robot.drive == DriveKind::kCable ? tracks.q_m : tracks.tau_m;
  const EvenGrid grid = evenGrid(drivenTimes(tracks, input), kLongestGap);
  Evidence evidence;
  evidence.title = tracks.title;
  evidence.file = tracks.file;
  evidence.notices = tracks.notices;
  evidence.drive = robot.drive;
  evidence.joints = robot.size();
  evidence.step = grid.step;
  evidence.t = grid.t;
  evidence.segments = grid.segments;
  evidence.exclusions.assign(grid.t.size(), 0);
  placeChannels(evidence, grid, tracks);
  if (!evidence.q_m.empty()) differentiate(evidence);
  markSaturated(evidence, robot);
  for (std::size_t i = 0; i < evidence.rows(); ++i)
    if (evidence.t[i] < evidence.t.front() + options.skip_start) evidence.exclusions[i] |= kStart;
  placeObservations(evidence, grid, tracks, robot);
  checkLength(tracks, evidence);
  noticeLosses(evidence, tracks);
  return evidence;
}

}  // namespace capstan::diagnosis
