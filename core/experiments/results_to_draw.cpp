#include "core/experiments/results_to_draw.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/experiments/run.h"
#include "core/stats/running_rms.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;

/// Over the points that know the error in all three joints.
template <class Point>
void takeRms(TrialResult& trial, Estimator which, const std::vector<Point>& points,
             Eigen::Vector3d Point::*error) {
  stats::RunningRms<3> rms;
  for (const Point& point : points)
    if ((point.*error).allFinite()) rms.add(point.*error);
  const auto index = static_cast<std::size_t>(which);
  trial.counts[index] = rms.count();
  if (rms.count() > 0) trial.rms[index] = rms.value();
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

Results resultsOfRecording(const fs::path& recording, const fs::path& robot, const std::string& software,
                           base::Progress& progress) {
  Specification specification;
  specification.name = fileNameOf(recording.stem().string());
  specification.title = recording.filename().string();
  if (!robot.empty()) {
    specification.robot = {fs::absolute(robot).string()};
    specification.name += "-" + fileNameOf(robot.stem().string());
    specification.title += ", " + robot.stem().string();
  }
  specification.trials.resize(1);
  specification.trials[0].name = recording.stem().string();
  specification.trials[0].recording = fs::absolute(recording).string();
  RunOptions options;
  options.threads = 1;
  options.software = software;
  return run(specification, options, progress);
}

Results resultsOfErrors(const ErrorRun& run, const std::string& software) {
  Results results;
  results.name = "session";
  results.title = run.title;
  results.software = software;
  results.simulated = run.simulated;
  TrialResult& trial = results.trials.emplace_back();
  trial.name = "session";
  trial.simulated = run.simulated;
  trial.own_kinematics = run.own_kinematics;
  trial.reference = !run.own_kinematics;
  trial.begin = run.begin;
  trial.end = run.end;
  trial.errors = run.errors;
  trial.camera = run.camera;
  trial.trajectory = run.trajectory;
  const auto occluded = std::count_if(run.errors.begin(), run.errors.end(),
                                      [](const ErrorPoint& point) { return point.occluded; });
  if (!run.errors.empty())
    trial.occluded_share = static_cast<double>(occluded) / static_cast<double>(run.errors.size());
  takeRms(trial, Estimator::kKinematic, run.errors, &ErrorPoint::kinematic);
  takeRms(trial, Estimator::kIdentified, run.errors, &ErrorPoint::identified);
  takeRms(trial, Estimator::kUkf, run.errors, &ErrorPoint::ukf);
  takeRms(trial, Estimator::kCamera, run.camera, &CameraPoint::error);
  return results;
}

void tellApart(std::vector<Results>& all) {
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto taken = [&](const std::string& name) {
      return std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const Results& one) { return one.name == name; });
    };
    const std::string name = all[i].name;
    for (char letter = 'B'; taken(all[i].name) && letter <= 'Z'; ++letter) all[i].name = name + "-" + letter;
  }
}

}  // namespace capstan::experiments
