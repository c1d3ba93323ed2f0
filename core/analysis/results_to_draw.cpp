#include "core/analysis/results_to_draw.h"

#include <algorithm>

#include "core/base/error.h"

namespace capstan::analysis {
namespace {

namespace fs = std::filesystem;

/// Sets RMS and count: over all samples of the run, or without moments over its points with finite errors.
template <class Point>
void takeRms(experiments::TrialResult& trial, const ErrorRun& run, experiments::Estimator which,
             const std::vector<Point>& points, Eigen::Vector3d Point::*error) {
  ErrorMoments all = run.momentsOf(which, TimeShare::kAll);
  if (all.n == 0)
    for (const Point& point : points) all.add(point.*error);
  const auto index = static_cast<std::size_t>(which);
  trial.counts[index] = all.n;
  if (all.n > 0) trial.rms[index] = all.rms();
}

/// Occluded share of the instants at which the UKF's error is known.
double occludedShare(const ErrorRun& run) {
  const auto count = [&](TimeShare share) {
    return static_cast<double>(run.momentsOf(experiments::Estimator::kUkf, share).n);
  };
  if (count(TimeShare::kAll) > 0.0) return count(TimeShare::kOccluded) / count(TimeShare::kAll);
  if (run.errors.empty()) return 0.0;
  const auto occluded = std::count_if(run.errors.begin(), run.errors.end(),
                                      [](const experiments::ErrorPoint& point) { return point.occluded; });
  return static_cast<double>(occluded) / static_cast<double>(run.errors.size());
}

}  // namespace

std::vector<fs::path> resultFolders(const fs::path& folder) {
  if (fs::exists(folder / "results.json")) return {folder};
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_directory() && fs::exists(entry.path() / "results.json")) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  if (found.empty())
    throw base::InputError({folder.string(),
                            0,
                            {},
                            {},
                            "holds no results.json, nor does a folder in it",
                            "Give the --out folder of capstan-cli experiment, or a recording"});
  return found;
}

experiments::Results resultsOfRecording(const fs::path& recording, const fs::path& robot,
                                        const std::string& software, base::Progress& progress) {
  experiments::Results results = resultsOfErrors(trackRun(recording, robot, progress), software);
  results.cancelled = progress.cancelled();
  return results;
}

experiments::Results resultsOfErrors(const ErrorRun& run, const std::string& software) {
  experiments::Results results;
  results.name = run.name;
  results.title = run.title;
  results.software = software;
  results.simulated = run.simulated;
  experiments::TrialResult& trial = results.trials.emplace_back();
  trial.name = run.trial;
  trial.simulated = run.simulated;
  trial.own_kinematics = run.own_kinematics;
  trial.reference = !run.own_kinematics && !run.errors.empty();
  trial.kinematic_robot = run.kinematic_robot;
  trial.filter_robot = run.filter_robot;
  trial.begin = run.begin;
  trial.end = run.end;
  trial.errors = run.errors;
  trial.camera = run.camera;
  trial.trajectory = run.trajectory;
  trial.occluded_share = occludedShare(run);
  takeRms(trial, run, experiments::Estimator::kKinematic, run.errors, &experiments::ErrorPoint::kinematic);
  takeRms(trial, run, experiments::Estimator::kIdentified, run.errors, &experiments::ErrorPoint::identified);
  takeRms(trial, run, experiments::Estimator::kUkf, run.errors, &experiments::ErrorPoint::ukf);
  takeRms(trial, run, experiments::Estimator::kCamera, run.camera, &experiments::CameraPoint::error);
  return results;
}

void distinguish(std::vector<experiments::Results>& all) {
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto taken = [&](const std::string& name) {
      return std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const experiments::Results& one) { return one.name == name; });
    };
    const std::string name = all[i].name;
    for (char letter = 'B'; taken(all[i].name) && letter <= 'Z'; ++letter) all[i].name = name + "-" + letter;
  }
}

}  // namespace capstan::analysis
