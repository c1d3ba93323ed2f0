#include "app/python/native/correction.h"

#include <pybind11/stl.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "app/cli/pose_motions.h"
#include "app/python/native/module.h"
#include "app/python/native/table_input.h"
#include "app/python/native/work.h"
#include "core/recording/pose_path.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// Commands as columns, one row per desired pose.
struct Commands {
  std::vector<double> trajectory, t, position, quaternion, sigma, confidence;

  void add(double number, double time, const Eigen::Isometry3d& pose, double trust) {
    trajectory.push_back(number);
    t.push_back(time);
    append(position, pose.translation());
    const Eigen::Vector4d q = Eigen::Quaterniond(pose.linear()).coeffs();
    quaternion.insert(quaternion.end(), q.data(), q.data() + 4);
    confidence.push_back(trust);
  }
};

recording::PosePaths pathsOf(const TableInput& desired) {
  return desired.isFile() ? recording::readPosePaths(desired.name())
                          : recording::readPosePaths(desired.columns(), desired.name());
}

Commands correctPoses(const learning::CorrectionModel& model, const recording::PosePaths& paths,
                      const std::vector<learning::State>& states) {
  const std::vector<learning::Corrected> corrected = model.correctWithConfidence(states);
  Commands commands;
  std::size_t k = 0;
  for (const recording::PosePath& path : paths.paths)
    for (const learning::StampedPose& pose : path.poses) {
      const learning::Corrected& one = corrected[k++];
      commands.add(path.trajectory, pose.t, one.pose, one.confidence);
      commands.sigma.insert(commands.sigma.end(), one.sigma.data(), one.sigma.data() + 6);
    }
  return commands;
}

Commands correctMotions(const learning::CorrectionModel& model, const recording::PosePaths& paths,
                        learning::CorrectionMode mode, const std::string& name) {
  learning::CommandCorrectionOptions options;
  options.mode = mode;
  Commands commands;
  const auto motions = recording::plannedMotions(paths, name);
  for (std::size_t m = 0; m < motions.size(); ++m)
    for (const learning::CorrectedWaypoint& waypoint :
         base::namingFile(name, [&] { return learning::correctedPath(model, motions[m], options); }))
      commands.add(paths.paths[m].trajectory, waypoint.t, waypoint.command, waypoint.confidence);
  return commands;
}

py::dict correct(const Correction& correction, const py::object& given, const std::string& mode,
                 const py::object& progress) {
  const TableInput desired(given);
  bool timed = false;
  Commands commands = cancellable(progress, [&](base::Progress&) {
    const recording::PosePaths paths = pathsOf(desired);
    const std::vector<learning::State> states = recording::statesOf(paths);
    cli::checkNear(correction->model, states, desired.name());
    timed = paths.timed;
    if (mode == "poses") return correctPoses(correction->model, paths, states);
    return correctMotions(
        correction->model, paths,
        mode == "path" ? learning::CorrectionMode::kFullTrajectory : learning::CorrectionMode::kEndPoint,
        desired.name());
  });
  py::dict result;
  result["traj"] = arrayOf(std::move(commands.trajectory));
  result["t"] = timed ? py::object(arrayOf(std::move(commands.t))) : py::object(py::none());
  result["position"] = rowsOf(std::move(commands.position), 3);
  result["quaternion"] = rowsOf(std::move(commands.quaternion), 4);
  result["sigma"] =
      mode == "poses" ? py::object(rowsOf(std::move(commands.sigma), 6)) : py::object(py::none());
  result["confidence"] = arrayOf(std::move(commands.confidence));
  return result;
}

}  // namespace

void addCorrection(py::module_& module) {
  module.attr("low_confidence") = learning::kLowConfidence;
  py::class_<learning::CorrectionFile, Correction>(module, "Correction")
      .def_static("read",
                  [](const std::string& path) {
                    return std::make_shared<learning::CorrectionFile>(learning::readCorrection(path));
                  })
      .def("write", [](const Correction& correction,
                       const std::string& path) { learning::writeCorrection(*correction, path); })
      .def("correct", &correct)
      .def("offset",
           [](const Correction& correction) { return matrixArray(correction->model.offset().matrix()); })
      .def("rigid", [](const Correction& correction) { return correction->model.processes().empty(); })
      .def("source", [](const Correction& correction) {
        const learning::CorrectionSource& source = correction->source;
        py::dict result;
        result["files"] = source.files;
        result["towards"] = std::string(base::nameOf(source.towards));
        result["clock_offset"] = source.clock_offset;
        result["states"] = source.states;
        result["rejected"] = source.rejected;
        result["software"] = source.software;
        return result;
      });
}

}  // namespace capstan::python
