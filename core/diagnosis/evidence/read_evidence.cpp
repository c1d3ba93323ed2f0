#include "core/diagnosis/evidence/read_evidence.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <variant>

#include "core/diagnosis/evidence/recorded_tracks.h"
#include "core/recording/read_table.h"
#include "core/recording/session_source.h"
#include "core/recording/settle_units.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Vector3d;

void leaveOutJoints(RecordedTracks& tracks) {
  tracks.t_q.clear(), tracks.q.clear();
  tracks.own_kinematics = true;
  tracks.notices.push_back(fmt::format(
      "{}: joint positions are excluded, because the robot computed them from its motors", tracks.title));
}

bool hasNumbers(const Columns& columns) {
  return std::any_of(columns.begin(), columns.end(), [](const std::vector<double>& column) {
    return std::any_of(column.begin(), column.end(), [](double x) { return std::isfinite(x); });
  });
}

void push(Columns& columns, const Vector3d& value) {
  columns.resize(3);
  for (int i = 0; i < 3; ++i) columns[static_cast<std::size_t>(i)].push_back(value(i));
}

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> moved;
  moved.reserve(values.size());
  for (const std::size_t i : order) moved.push_back(values[i]);
  values = std::move(moved);
}

/// Indices in order of rising time; of equal times the first alone.
std::vector<std::size_t> risingOrder(const std::vector<double>& t) {
  std::vector<std::size_t> order(t.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return t[a] < t[b]; });
  order.erase(std::unique(order.begin(), order.end(), [&](auto a, auto b) { return t[a] == t[b]; }),
              order.end());
  return order;
}

/// Collects the samples of a source, and the tips that the pipeline found in its images.
class TrackCollector {
 public:
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) addMotor(*motor);
    if (const auto* joint = std::get_if<tracking::JointSample>(&sample))
      tracks_.t_q.push_back(joint->t), push(tracks_.q, joint->position);
    if (!snapshot.camera_updated || !snapshot.tip_cam.allFinite()) return;
    tracks_.t_tip.push_back(snapshot.t_cam);
    tracks_.tip.push_back(snapshot.tip_cam);
  }

  RecordedTracks finish(const tracking::SourceInfo& info) {
    tracks_.title = tracks_.file = info.title;
    tracks_.notices = info.notices;
    if (info.own_kinematics) leaveOutJoints(tracks_);
    for (Columns* columns : {&tracks_.dq_m, &tracks_.tau_m, &tracks_.q})
      if (!hasNumbers(*columns)) columns->clear();
    const std::vector<std::size_t> joints = risingOrder(tracks_.t_q), tips = risingOrder(tracks_.t_tip);
    reorder(tracks_.t_q, joints);
    for (std::vector<double>& column : tracks_.q) reorder(column, joints);
    reorder(tracks_.t_tip, tips);
    reorder(tracks_.tip, tips);
    return std::move(tracks_);
  }

 private:
  void addMotor(const tracking::MotorSample& motor) {
    if (!std::isfinite(motor.t) || (!tracks_.t.empty() && motor.t <= tracks_.t.back())) return;
    tracks_.t.push_back(motor.t);
    push(tracks_.q_m, motor.position);
    push(tracks_.dq_m, motor.velocity);
    push(tracks_.tau_m, motor.torque);
  }

  RecordedTracks tracks_;
};

RecordedTracks tracksOf(const recording::MeasuredTable& table) {
  RecordedTracks tracks;
  tracks.file = table.file;
  tracks.title = std::filesystem::path(table.file).filename().string();
  tracks.t = table.t;
  for (const auto& [from, to] :
       {std::pair{&table.q_m, &tracks.q_m}, std::pair{&table.dq_m, &tracks.dq_m},
        std::pair{&table.tau_m, &tracks.tau_m}, std::pair{&table.tau_ext, &tracks.tau_ext}})
    if (hasNumbers(*from)) *to = *from;
  if (hasNumbers(table.q)) tracks.t_q = table.t, tracks.q = table.q;
  if (table.own_kinematics) leaveOutJoints(tracks);
  for (std::size_t i = 0; i < table.rows() && !table.p_c.empty(); ++i) {
    const Vector3d tip(table.p_c[0][i], table.p_c[1][i], table.p_c[2][i]);
    if (tip.allFinite()) tracks.t_tip.push_back(table.t[i]), tracks.tip.push_back(tip);
  }
  for (const std::string& line : recording::unitNotices(table))
    tracks.notices.push_back(table.file + ": " + line);
  if (!table.ignored.empty())
    tracks.notices.push_back(
        fmt::format("{}: columns not used: {}", table.file, fmt::join(table.ignored, ", ")));
  return tracks;
}

}  // namespace

Evidence evidenceOf(const recording::MeasuredTable& table, const robot::Description& robot,
                    const EvidenceOptions& options) {
  return assembleEvidence(tracksOf(table), robot, options);
}

Evidence evidenceOf(tracking::Source& source, const EvidenceOptions& options, base::Progress* progress) {
  const tracking::SourceInfo& info = source.info();
  tracking::TrackingPipeline pipeline =
      tracking::makePipeline(info, tracking::sixState(tracking::trackingOptionsOf(info)));
  TrackCollector collector;
  tracking::trackAll(source, pipeline, progress, info.duration,
                     [&](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                       collector.add(sample, snapshot);
                     });
  Evidence evidence = assembleEvidence(collector.finish(info), info.robot, options);
  evidence.robot = info.robot;
  return evidence;
}

Evidence readEvidence(const std::filesystem::path& path, const robot::Description& robot,
                      const EvidenceOptions& options, base::Progress* progress) {
  if (recording::isSession(path)) {
    recording::SessionSource source(path);
    Evidence evidence = evidenceOf(source, options, progress);
    evidence.file = path.string();
    return evidence;
  }
  return evidenceOf(recording::readTable(path, robot, options.read_as), robot, options);
}

}  // namespace capstan::diagnosis
