#include "core/learning/poses/check_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/learning/poses/screen_poses.h"
#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

void checkPoses(const ScreenReport& screen, StreamKind stream) {
  const auto at = static_cast<std::size_t>(stream);
  if (screen.poses[at] > 0) return;
  std::string reasons;
  for (const auto& [reason, name] : base::NamesOf<Reason>::value)
    if (const std::size_t n = screen.count(stream, reason); n > 0) reasons += fmt::format(", {} {}", n, name);
  throw base::InputError({{},
                          0,
                          std::string(base::nameOf(stream)),
                          {},
                          screen.rows[at] == 0
                              ? "these tables have no such poses"
                              : fmt::format("has no pose in {} rows{}", screen.rows[at], reasons),
                          "Give tables with this stream, quaternions of norm 1 as x, y, z, w"});
}

/// Checks the unit of stamps. Poses are paired within kLongestGap; commands that are seconds apart have
/// stamps in another unit.
void checkStamps(const ScreenReport& screen, StreamKind reference) {
  constexpr double kLongest = 2.0;  // [s]
  std::vector<double> steps;
  for (const PoseMotion& motion : screen.motions)
    for (std::size_t k = 1; k < motion.of(reference).size(); ++k)
      steps.push_back(motion.of(reference)[k].t - motion.of(reference)[k - 1].t);
  const double step = steps.empty() ? 0.0 : stats::median(std::move(steps));
  if (step <= kLongest) return;
  throw base::InputError({{},
                          0,
                          fmt::format("stamps of the {}", base::nameOf(reference)),
                          fmt::format("{:.3g} s", step),
                          "is the median time from pose to pose, too long to follow a motion",
                          "Give stamps in seconds, and poses at 10 Hz or more"});
}

/// Interquartile range of a stream's positions along each axis [m].
Eigen::Vector3d halfWidthsOf(const std::vector<PoseMotion>& motions, StreamKind stream) {
  constexpr std::array kQuartiles = {0.25, 0.75};
  Eigen::Vector3d widths;
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::vector<double> along;
    for (const PoseMotion& motion : motions)
      for (const StampedPose& at : motion.of(stream)) along.push_back(at.pose.translation()[i]);
    const std::vector<double> ends = stats::quantiles(along, kQuartiles);
    widths[i] = ends[1] - ends[0];
  }
  return widths;
}

/// Checks the unit of positions: their interquartile range cannot exceed the length of an arm, whatever
/// outliers there are.
void checkMetres(const ScreenReport& screen, StreamKind stream) {
  constexpr double kWidest = 1.5;  // [m]
  const Eigen::Vector3d widths = halfWidthsOf(screen.motions, stream);
  std::string axes;
  for (Eigen::Index i = 0; i < 3; ++i)
    if (widths[i] > kWidest) axes += fmt::format("{}{}", axes.empty() ? "" : ", ", "xyz"[i]);
  if (axes.empty()) return;
  throw base::InputError({{},
                          0,
                          fmt::format("positions of the {}", base::nameOf(stream)),
                          fmt::format("{:.3g} m", widths.maxCoeff()),
                          "is their interquartile range, larger than an arm's reach",
                          fmt::format("Give {} of the {} in metres", axes, base::nameOf(stream))});
}

void checkTable(std::span<const RawMotion> motions, StreamKind towards) {
  const ScreenReport screen = screenPoses(motions);
  checkPoses(screen, StreamKind::kCamera);
  checkPoses(screen, towards);
  checkStamps(screen, towards);
  checkMetres(screen, StreamKind::kCamera);
  checkMetres(screen, towards);
}

}  // namespace

void checkTables(std::span<const RawMotion> motions, StreamKind towards) {
  if (motions.empty()) checkTable(motions, towards);
  while (!motions.empty()) {
    const std::string& table = motions.front().table;
    const auto end = std::ranges::find_if(motions, [&](const RawMotion& m) { return m.table != table; });
    const auto count = static_cast<std::size_t>(end - motions.begin());
    base::namingFile(table, [&] { checkTable(motions.first(count), towards); });
    motions = motions.subspan(count);
  }
}

}  // namespace capstan::learning
