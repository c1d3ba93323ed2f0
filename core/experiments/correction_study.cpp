#include "core/experiments/correction_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/random.h"
#include "core/stats/quantile.h"

namespace capstan::experiments {
namespace {

using learning::State;
using learning::Vector6d;
using M = CorrectionMethod;

constexpr double kMillimetres = 1e3, kDegrees = 180.0 / std::numbers::pi;

/// Errors of many states, before they are summed up.
struct Pool {
  std::vector<Vector6d> apart;  ///< absolute
  std::vector<double> distance, angle;

  void add(const Eigen::Isometry3d& corrected, const Eigen::Isometry3d& told) {
    const learning::PoseFeatures angles(learning::RotationForm::kYawPitchRoll, learning::Motion::kNone,
                                        Eigen::Quaterniond::Identity());
    apart.push_back(angles.correction(corrected, told).cwiseAbs());
    distance.push_back((corrected.translation() - told.translation()).norm());
    angle.push_back(
        Eigen::Quaterniond(corrected.linear()).angularDistance(Eigen::Quaterniond(told.linear())));
  }
  void add(const Pool& other) {
    apart.insert(apart.end(), other.apart.begin(), other.apart.end());
    distance.insert(distance.end(), other.distance.begin(), other.distance.end());
    angle.insert(angle.end(), other.angle.begin(), other.angle.end());
  }
};

double meanOf(const std::vector<double>& x) {
  return x.empty() ? 0.0 : std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

CorrectionErrors summed(const Pool& pool) {
  CorrectionErrors errors;
  errors.states = pool.apart.size();
  for (int k = 0; k < 6; ++k) {
    std::vector<double> one;
    for (const Vector6d& apart : pool.apart) one.push_back(apart[k]);
    errors.mean[k] = meanOf(one);
    errors.median[k] = stats::median(one);
    for (double& x : one) x = std::pow(x - errors.mean[k], 2);
    errors.deviation[k] = std::sqrt(meanOf(one));
  }
  errors.distance = meanOf(pool.distance);
  errors.median_distance = stats::median(pool.distance);
  errors.angle = meanOf(pool.angle);
  errors.median_angle = stats::median(pool.angle);
  return errors;
}

/// Which motions are held out: `share` of those that have states.
std::vector<bool> heldOut(const std::vector<State>& states, double share, std::uint64_t seed) {
  std::vector<std::size_t> motions;
  for (const State& state : states)
    if (motions.empty() || motions.back() != state.motion) motions.push_back(state.motion);
  std::vector<bool> held(states.empty() ? 0 : states.back().motion + 1, false);
  const auto count = static_cast<Eigen::Index>(std::lround(share * static_cast<double>(motions.size())));
  for (const Eigen::Index k : learning::drawnPoints(static_cast<Eigen::Index>(motions.size()), count, seed))
    held[motions[static_cast<std::size_t>(k)]] = true;
  return held;
}

std::vector<Eigen::Isometry3d> told(M method, const std::vector<State>& train,
                                    const std::vector<State>& clean, const std::vector<State>& test,
                                    const CorrectionStudyOptions& options) {
  std::vector<Eigen::Isometry3d> poses;
  if (method >= M::kProcess) {
    const bool cleaned = method == M::kAll || method == M::kHistory;
    learning::CorrectionOptions correction = options.correction;
    correction.motion = method == M::kProcess   ? learning::Motion::kNone
                        : method == M::kHistory ? learning::Motion::kHistory
                                                : learning::Motion::kVelocity;
    return learning::CorrectionModel::trained(cleaned ? clean : train, correction).correct(test);
  }
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  std::vector<learning::PosePair> pairs;
  for (const State& state : method == M::kOffsetCleaning ? clean : train) pairs.push_back(state.pair);
  if (method != M::kNone) offset = learning::rigidOffset(pairs, options.correction.lever);
  for (const State& state : test) poses.push_back(offset * state.pair.seen);
  return poses;
}

}  // namespace

CorrectionStudyReport correctionStudy(const std::vector<State>& states, const CorrectionStudyOptions& options,
                                      base::Progress* progress) {
  CorrectionStudyReport report;
  std::array<Pool, kCorrectionMethods> dirty, clean;
  for (int split = 0; split < options.splits; ++split) {
    const std::vector<bool> held =
        heldOut(states, options.test_share, options.seed + static_cast<std::uint64_t>(split));
    std::vector<State> train, test;
    for (const State& state : states) (held[state.motion] ? test : train).push_back(state);
    const learning::CleaningReport cleaned = learning::cleanStates(train, options.cleaning);
    const std::vector<State> clean_train = learning::kept(train, cleaned);
    const std::vector<learning::Reason> reasons = learning::judgedBy(cleaned, test, options.cleaning);
    for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
      if (progress && progress->cancelled()) {
        report.cancelled = true;
        return report;
      }
      const auto method = static_cast<M>(m);
      if (progress)
        progress->report((split + static_cast<double>(m) / kCorrectionMethods) / options.splits,
                         fmt::format("Split {}: {}", split + 1, base::nameOf(method)));
      const std::vector<Eigen::Isometry3d> poses = told(method, train, clean_train, test, options);
      Pool all, kept;
      for (std::size_t k = 0; k < test.size(); ++k) {
        all.add(poses[k], test[k].pair.told);
        if (reasons[k] == learning::Reason::kNone) kept.add(poses[k], test[k].pair.told);
      }
      if (method == M::kHistory) report.by_split.push_back({summed(all), summed(kept)});
      dirty[m].add(all);
      clean[m].add(kept);
    }
  }
  for (std::size_t m = 0; m < kCorrectionMethods; ++m) {
    report.dirty[m] = summed(dirty[m]);
    report.clean[m] = summed(clean[m]);
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

}  // namespace capstan::experiments
