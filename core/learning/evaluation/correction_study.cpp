#include "core/learning/evaluation/correction_study.h"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "core/base/progress_part.h"
#include "core/learning/evaluation/held_out.h"
#include "core/learning/poses/training_states.h"
#include "core/stats/rms.h"

namespace capstan::learning {
namespace {

using learning::State;
using M = CorrectionMethod;

constexpr M kOurs = M::kCommittee;
constexpr double kMillimetres = 1e3, kDegrees = 180.0 / std::numbers::pi;

learning::Motion motionOf(M method) {
  if (method == M::kProcess) return learning::Motion::kNone;
  return method >= M::kHistory ? learning::Motion::kHistory : learning::Motion::kVelocity;
}

/// Training and test data of a split.
struct Split {
  std::vector<State> train, clean;
  learning::TrainingStates weighed;
  std::vector<State> test, clean_test;
  std::vector<learning::Reason> judged;  ///< reasons for the states of `test`
};

Split splitOf(const std::vector<State>& states, const CorrectionStudyOptions& options, int number,
              base::Progress* progress, const base::ProgressPart& part) {
  const std::vector<bool> held =
      heldOut(states, options.test_share, options.seed + static_cast<std::uint64_t>(number));
  auto [train, test] = splitStates(states, held);
  const learning::CleaningReport cleaned = learning::cleanStates(train, options.cleaning);
  learning::CleaningReport judged;
  judged.reason = learning::judgedBy(cleaned, test, options.cleaning);
  learning::TrainingStates training = learning::trainingStates(train, cleaned);
  std::vector<State> clean = training.states;
  learning::CorrectionOptions correction = options.correction;
  correction.motion = motionOf(M::kWeights);
  learning::weigh(training, train, correction, progress, part);
  std::vector<State> clean_test = learning::kept(test, judged);
  return {std::move(train), std::move(clean),      std::move(training),
          std::move(test),  std::move(clean_test), std::move(judged.reason)};
}

std::vector<Eigen::Isometry3d> byOffset(M method, const Split& split) {
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  const auto pairs = learning::pairsOf(method == M::kOffsetCleaning ? split.clean : split.train);
  if (method != M::kUncorrected) offset = learning::rigidOffset(pairs);
  std::vector<Eigen::Isometry3d> poses;
  for (const State& state : split.test) poses.push_back(offset * state.pair.observed);
  return poses;
}

learning::CorrectionModel modelBy(M method, const Split& split, learning::CorrectionOptions options,
                                  base::Progress* progress, const base::ProgressPart& part) {
  options.motion = motionOf(method);
  options.fit.kernel = method < M::kMatern ? learning::Kernel::kRbf : learning::Kernel::kMatern;
  if (method < M::kCommittee) options.members = 1;
  if (method >= M::kWeights) {
    options.offset = split.weighed.offset;
    return learning::CorrectionModel::trained(split.weighed.states, options, progress, part);
  }
  const bool cleaned = method >= M::kAll;
  return learning::CorrectionModel::trained(cleaned ? split.clean : split.train, options, progress, part);
}

/// Errors of all test states, and of the clean ones.
std::pair<PoseErrors, PoseErrors> errorsOf(const Split& split, const std::vector<Eigen::Isometry3d>& poses,
                                           const Eigen::Quaterniond& middle) {
  PoseErrors all{middle, {}, {}, {}}, kept = all;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    all.add(poses[k], split.test[k].pair.commanded);
    if (split.judged[k] == learning::Reason::kNone) kept.add(poses[k], split.test[k].pair.commanded);
  }
  return {std::move(all), std::move(kept)};
}

/// Errors of successive clean states, and the changes of these errors.
class Jitters {
 public:
  void add(const std::vector<State>& states, const std::vector<learning::Reason>& reason,
           const std::vector<Eigen::Isometry3d>& poses) {
    const auto offAt = [&](std::size_t k) { return poses[k].inverse() * states[k].pair.commanded; };
    for (std::size_t k = 1; k < states.size(); ++k) {
      if (states[k].motion != states[k - 1].motion || reason[k] != learning::Reason::kNone ||
          reason[k - 1] != learning::Reason::kNone || states[k].t - states[k - 1].t > kNeighbours)
        continue;
      const Eigen::Isometry3d before = offAt(k - 1), now = offAt(k);
      distance_.push_back(now.translation().norm());
      angle_.push_back(angleOf(now.linear()));
      distance_change_.push_back((now.translation() - before.translation()).norm());
      angle_change_.push_back(angleOf(before.linear().transpose() * now.linear()));
    }
  }
  ErrorJitter shares() const {
    return {shareOf(distance_change_, distance_), shareOf(angle_change_, angle_)};
  }

 private:
  static constexpr double kNeighbours = 0.25;  // [s]
  static double angleOf(const Eigen::Matrix3d& rotation) { return Eigen::AngleAxisd(rotation).angle(); }
  static double shareOf(const std::vector<double>& change, const std::vector<double>& all) {
    const double of_change = stats::rms(change), of_all = stats::rms(all);
    return of_all > 0.0 ? 0.5 * of_change * of_change / (of_all * of_all) : 0.0;
  }
  std::vector<double> distance_, angle_, distance_change_, angle_change_;
};

}  // namespace

CorrectionStudyReport correctionStudy(const std::vector<State>& states, const CorrectionStudyOptions& options,
                                      base::Progress* progress) {
  CorrectionStudyReport report;
  std::array<PoseErrors, kCorrectionMethods> dirty, clean;
  Jitters jitters;
  const Eigen::Quaterniond middle = middleCommandOf(states);
  for (int number = 0; number < options.splits; ++number) {
    // weigh() takes about as long as a method.
    const auto partOf = [&](std::size_t m, std::string_view doing) {
      const double share = 1.0 / (kCorrectionMethods + 1) / options.splits;
      const double done = static_cast<double>(number) / options.splits + static_cast<double>(m) * share;
      return base::ProgressPart{done, done + share,
                                fmt::format("Split {} of {}: {}", number + 1, options.splits, doing)};
    };
    const Split split = splitOf(states, options, number, progress, partOf(0, "weighing"));
    for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
      const auto method = static_cast<M>(m);
      std::vector<Eigen::Isometry3d> poses;
      if (method < M::kProcess) {
        poses = byOffset(method, split);
      } else {
        const learning::CorrectionModel model =
            modelBy(method, split, options.correction, progress, partOf(m + 1, base::nameOf(method)));
        poses = model.correct(split.test);
        if (method == kOurs) report.stated.add(model, split.clean_test);
        if (method == kOurs) jitters.add(split.test, split.judged, poses);
      }
      if (progress && progress->cancelled()) {
        report.cancelled = true;
        return report;
      }
      const auto [all, kept] = errorsOf(split, poses, middle);
      if (method == kOurs) report.by_split.push_back({all.summed(), kept.summed()});
      dirty[m].add(all);
      clean[m].add(kept);
    }
  }
  report.jitter = jitters.shares();
  for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
    report.dirty[m] = dirty[m].summed();
    report.clean[m] = clean[m].summed();
    report.distances[m] = std::move(clean[m].distance);
    report.angles[m] = std::move(clean[m].angle);
  }
  return report;
}

const PaperTable& paperDirty() {
  static const PaperTable table = {{
      {{{17.6, 8.3}, {17.5, 5.0}, {9.0, 7.4}, {5.5, 10.4}, {11.6, 9.3}, {22.3, 22.5}}},
      {{{4.2, 10.2}, {6.0, 4.7}, {8.3, 7.2}, {4.9, 9.8}, {7.7, 9.4}, {7.3, 23.6}}},
      {{{2.6, 4.6}, {5.9, 3.9}, {8.1, 6.4}, {4.6, 7.8}, {6.9, 7.0}, {12.0, 21.9}}},
      {{{4.2, 9.9}, {2.6, 3.8}, {2.3, 5.1}, {2.0, 7.1}, {3.2, 7.9}, {1.7, 9.4}}},
      {{{1.6, 3.9}, {1.6, 1.9}, {1.5, 2.2}, {1.8, 3.4}, {1.9, 3.6}, {2.1, 3.4}}},
      {{{1.6, 1.6}, {1.5, 1.5}, {1.4, 1.6}, {1.4, 2.3}, {1.5, 1.8}, {1.7, 3.3}}},
  }};
  return table;
}

const PaperTable& paperClean() {
  static const PaperTable table = {{
      {{{17.4, 2.6}, {17.1, 4.1}, {7.5, 4.2}, {3.2, 2.7}, {10.8, 6.4}, {16.6, 9.8}}},
      {{{2.9, 2.3}, {5.8, 3.5}, {7.8, 6.2}, {2.8, 1.8}, {6.0, 2.3}, {6.3, 3.2}}},
      {{{2.6, 2.1}, {4.0, 4.2}, {7.1, 5.3}, {2.9, 6.2}, {5.9, 4.2}, {6.6, 9.8}}},
      {{{3.4, 3.2}, {2.2, 2.1}, {1.6, 1.5}, {1.3, 1.8}, {2.3, 2.3}, {1.7, 3.2}}},
      {{{1.3, 1.3}, {1.5, 1.6}, {1.3, 1.3}, {1.5, 2.1}, {1.7, 2.0}, {2.0, 3.4}}},
      {{{1.4, 1.7}, {1.4, 1.5}, {1.1, 1.2}, {1.3, 2.0}, {1.6, 1.9}, {1.9, 3.1}}},
  }};
  return table;
}

base::Table correctionTable(const std::array<CorrectionErrors, kCorrectionMethods>& ours,
                            const PaperTable& paper, std::string title) {
  constexpr std::array kNames = {"x [mm]", "y [mm]", "z [mm]", "yaw [deg]", "pitch [deg]", "roll [deg]"};
  base::Table table;
  table.title = std::move(title);
  table.columns.push_back({.name = "", .unit = {}});
  for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
    table.columns.push_back({.name = std::string(base::nameOf(static_cast<M>(m))), .unit = {}});
    if (m < kPaperMethods) table.columns.push_back({.name = "paper", .unit = {}});
  }
  const auto cell = [](double mean, double deviation) {
    return fmt::format("{:.2f} ± {:.2f}", mean, deviation);
  };
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const double scale = k < 3 ? kMillimetres : kDegrees;
    const auto at = static_cast<Eigen::Index>(k);
    std::vector<base::TableCell> row = {kNames[k]};
    for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
      row.emplace_back(cell(scale * ours[m].mean[at], scale * ours[m].deviation[at]));
      if (m < kPaperMethods) row.emplace_back(cell(paper[m][k].mean, paper[m][k].deviation));
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<base::TableCell> distance = {"distance [mm], median"}, angle = {"angle [deg], median"};
  for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
    const CorrectionErrors& e = ours[m];
    distance.emplace_back(
        fmt::format("{:.2f}, {:.2f}", kMillimetres * e.distance, kMillimetres * e.median_distance));
    angle.emplace_back(fmt::format("{:.2f}, {:.2f}", kDegrees * e.angle, kDegrees * e.median_angle));
    if (m >= kPaperMethods) continue;
    distance.emplace_back("");
    angle.emplace_back("");
  }
  table.rows.push_back(std::move(distance));
  table.rows.push_back(std::move(angle));
  table.note = "Mean ± standard deviation of absolute errors.";
  return table;
}

}  // namespace capstan::learning
