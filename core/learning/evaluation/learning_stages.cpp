#include "core/learning/evaluation/learning_stages.h"

#include <fmt/format.h>

#include <array>

#include "core/base/error.h"
#include "core/base/table.h"
#include "core/learning/poses/related_streams.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

using learning::State;
using learning::StreamKind;

constexpr auto kCamera = static_cast<std::size_t>(StreamKind::kCamera);

void checkStates(const LearningStages& stages) {
  if (stages.states.size() >= learning::kFewestStates) return;
  throw base::InputError({"pose tables", 0, "states", fmt::format("{}", stages.states.size()),
                          fmt::format("camera and {} overlap too little in time: {} states are needed",
                                      base::nameOf(stages.towards), learning::kFewestStates),
                          "Check the clocks of the streams, or record longer"});
}

std::vector<TrajectoryStates> motionsOf(const std::vector<State>& states,
                                        const learning::CleaningReport& cleaning) {
  std::vector<TrajectoryStates> motions;
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (motions.empty() || motions.back().motion != states[k].motion)
      motions.push_back({states[k].motion, k, k, 0});
    motions.back().end = k + 1;
    motions.back().rejected += cleaning.reason[k] != learning::Reason::kNone;
  }
  return motions;
}

void takeSpeeds(LearningStages& stages) {
  std::vector<double> speed, rotation_rate;
  for (const State& state : stages.states) {
    speed.push_back(state.velocity.head<3>().norm());
    rotation_rate.push_back(state.velocity.tail<3>().norm());
  }
  constexpr std::array kShares = {0.5, 0.99};
  const std::vector<double> speeds = stats::quantiles(speed, kShares);
  const std::vector<double> rates = stats::quantiles(rotation_rate, kShares);
  stages.speed = {speeds[0], speeds[1]};
  stages.rotation_rate = {rates[0], rates[1]};
}

void takeOffset(LearningStages& stages) {
  std::vector<learning::PosePair> pairs;
  for (std::size_t k = 0; k < stages.states.size(); ++k)
    if (stages.cleaning.reason[k] == learning::Reason::kNone) pairs.push_back(stages.states[k].pair);
  stages.offset = learning::rigidOffset(pairs);
  const Eigen::Quaterniond middle = middleCommandOf(stages.states);
  PoseErrors before{middle, {}, {}, {}}, after{middle, {}, {}, {}};
  for (const learning::PosePair& pair : pairs) {
    before.add(pair.observed, pair.commanded);
    after.add(stages.offset * pair.observed, pair.commanded);
  }
  stages.before = before.summed();
  stages.after = after.summed();
}

}  // namespace

LearningStages learningStages(const std::vector<learning::RawMotion>& motions, const LearningOptions& options,
                              base::Progress* progress) {
  LearningStages stages;
  constexpr double kPrepared = 0.7;  // share of the time
  stages.towards = options.towards;
  static_cast<PreparedStates&>(stages) = prepare(motions, options, progress, {0.2, kPrepared, {}});
  if (stages.cancelled) return stages;
  stages.unpaired = stages.screen.poses[kCamera] - stages.states.size();
  checkStates(stages);
  takeSpeeds(stages);
  if (progress) progress->report(kPrepared, "cleaning");
  stages.cleaning = learning::cleanStates(stages.states, options.cleaning);
  stages.motions = motionsOf(stages.states, stages.cleaning);
  takeOffset(stages);
  learning::checkRelated(stages.screen.motions, stages.states, stages.offset, options.towards);
  if (progress) progress->report(1.0, "done");
  return stages;
}

std::string rejectedCsv(const LearningStages& stages) {
  base::Table table;
  for (const char* name : {"trajectory", "stream", "line", "reason"})
    table.columns.push_back({.name = name, .unit = {}});
  const auto add = [&](std::size_t motion, StreamKind stream, std::size_t row, learning::Reason reason) {
    table.rows.push_back({stages.screen.motions[motion].name, std::string(base::nameOf(stream)),
                          static_cast<double>(row), std::string(base::nameOf(reason))});
  };
  for (const learning::RejectedRow& row : stages.screen.rejected)
    add(row.motion, row.stream, row.row, row.reason);
  for (std::size_t k = 0; k < stages.states.size(); ++k)
    if (stages.cleaning.reason[k] != learning::Reason::kNone)
      add(stages.states[k].motion, StreamKind::kCamera, stages.states[k].row, stages.cleaning.reason[k]);
  return base::csvOf(table);
}

}  // namespace capstan::learning
