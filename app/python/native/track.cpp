#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/registering.h"
#include "app/cli/track_output.h"
#include "app/python/native/json.h"
#include "app/python/native/module.h"
#include "app/python/native/sources.h"
#include "app/python/native/work.h"
#include "core/live/motor_failures.h"
#include "core/live/occluded_source.h"
#include "core/tracking/health.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// Options of track(), with the names and meanings of `capstan-cli track`.
struct TrackOptions {
  std::string robot, read_as, topics, estimator_robot, options, registration, mounting;
  double occlude = 0.0;
  std::vector<std::string> fail_motor;
  std::vector<int> failed_motor;
  bool whole_frame = false, estimates = true;
};

/// Columns of the estimates, as rows of joints.
struct EstimateColumns {
  std::vector<double> t, t_cam, nis;
  std::vector<double> q_kin, q_cam, q_ukf, dq_ukf, sigma_ukf, q;
  std::vector<std::int8_t> gate;
  std::vector<std::uint8_t> camera;

  void add(const recording::EstimateNumbers& row) {
    t.push_back(row.t);
    camera.push_back(row.camera ? 1 : 0);
    t_cam.push_back(row.t_cam);
    append(q_kin, row.q_kin);
    append(q_cam, row.q_cam);
    append(q_ukf, row.q_ukf);
    append(dq_ukf, row.dq_ukf);
    append(sigma_ukf, row.sigma_ukf);
    append(q, row.q);
    gate.push_back(static_cast<std::int8_t>(row.gate));
    nis.push_back(row.nis);
  }

  py::dict arrays() && {
    py::dict all;
    all["t"] = arrayOf(std::move(t));
    all["camera"] = arrayOf(std::move(camera)).attr("view")("bool");
    all["t_cam"] = arrayOf(std::move(t_cam));
    all["q_kin"] = rowsOf(std::move(q_kin), 3);
    all["q_cam"] = rowsOf(std::move(q_cam), 3);
    all["q_ukf"] = rowsOf(std::move(q_ukf), 3);
    all["dq_ukf"] = rowsOf(std::move(dq_ukf), 3);
    all["sigma_ukf"] = rowsOf(std::move(sigma_ukf), 3);
    all["q"] = rowsOf(std::move(q), 3);
    all["gate"] = arrayOf(std::move(gate));
    all["nis"] = arrayOf(std::move(nis));
    return all;
  }
};

struct Tracked {
  nlohmann::json document;
  EstimateColumns estimates;
  std::optional<Eigen::Isometry3d> base_from_camera;
  std::string registration;  ///< how the cameras were registered; empty: as stored
  std::vector<std::string> notices;
};

std::vector<live::MotorFailure> failuresOf(const TrackOptions& options) {
  std::vector<live::MotorFailure> all;
  for (const std::string& text : options.fail_motor) {
    const auto failures = live::parseMotorFailure(text, "fail_motor");
    all.insert(all.end(), failures.begin(), failures.end());
  }
  return all;
}

void check(const TrackOptions& options) {
  if (!options.mounting.empty() && options.registration != "hard-stop")
    cli::refuseOption("mounting", options.mounting, "is given without register='hard-stop'",
                      "Add that, or leave it out");
  if (!(options.occlude >= 0.0 && options.occlude <= 95.0))
    cli::refuseOption("occlude", std::to_string(options.occlude), "is not from 0 to 95 %",
                      "Give a share [%]");
  for (const int motor : options.failed_motor)
    if (motor < 1 || motor > 3)
      cli::refuseOption("failed_motor", std::to_string(motor), "is no motor", "Give 1, 2 or 3");
}

Tracked track(const TableInput& recording, const TrackOptions& given, base::Progress& progress) {
  const recording::ReadAs read_as = readAsOf(given.read_as);
  const cli::SourceFactory open = [&] { return openSource(recording, given.robot, read_as, given.topics); };
  const auto source = open();
  tracking::SourceInfo info = source->info();
  Tracked result;
  result.notices = info.notices;
  if (!given.estimator_robot.empty()) info.robot = robot::readDescriptionOrDefault(given.estimator_robot);
  auto options = given.options.empty() ? tracking::trackingOptionsOf(info)
                                       : tracking::readTrackingOptions(given.options);
  if (given.whole_frame) options.roi_search = false;
  if (given.registration != "stored") {
    info.base_from_camera =
        cli::registerBy(given.registration, given.mounting, open, options, result.registration);
  } else if (info.rig && !info.base_from_camera) {
    result.notices.emplace_back(
        "no registration is stored with this recording: the filter runs on kinematics (see register)");
  }
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, options);
  for (const int motor : given.failed_motor) pipeline.setMotorFailed(motor - 1, true);
  live::FailingMotors failing(*source, failuresOf(given));
  live::OccludedSource occluded(failing, live::OcclusionSchedule{.percentage = given.occlude});
  recording::EstimateSequence rows([&](const auto& row) { result.estimates.add(row); });
  const tracking::TrackReport report =
      tracking::trackAll(occluded, pipeline, &progress, info.duration,
                         [&](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                           if (given.estimates) rows.add(sample, snapshot);
                         });
  rows.flush();
  if (report.motor_samples == 0)
    cli::refuseFile(recording.name(), "holds no motor sample: nothing was tracked",
                    "Give a recording with motors");
  result.base_from_camera = info.base_from_camera;
  result.document = cli::documentOf(report, info, tracking::healthOf(report, info.robot, options.memory),
                                    given.estimator_robot);
  return result;
}

py::dict trackToPython(const py::object& recording, const TrackOptions& options, const py::object& progress) {
  check(options);
  const TableInput input(recording);
  Tracked tracked = cancellable(progress, [&](base::Progress& p) { return track(input, options, p); });
  py::dict result;
  result["report"] = documentToPython(std::move(tracked.document));
  result["estimates"] = std::move(tracked.estimates).arrays();
  result["base_from_camera"] = tracked.base_from_camera
                                   ? py::object(matrixArray(tracked.base_from_camera->matrix()))
                                   : py::object(py::none());
  result["registration"] = tracked.registration;
  result["notices"] = tracked.notices;
  return result;
}

}  // namespace

void addTrack(py::module_& module) {
  py::list gates;
  for (const auto& [gate, name] : base::KeysOf<tracking::Gate>::value) gates.append(std::string(name));
  module.attr("gates") = py::tuple(gates);
  module.def(
      "track",
      [](const py::object& recording, std::string robot, std::string read_as, std::string topics,
         std::string estimator_robot, std::string options, std::string registration, std::string mounting,
         double occlude, std::vector<std::string> fail_motor, std::vector<int> failed_motor, bool whole_frame,
         bool estimates, const py::object& progress) {
        return trackToPython(
            recording,
            {std::move(robot), std::move(read_as), std::move(topics), std::move(estimator_robot),
             std::move(options), std::move(registration), std::move(mounting), occlude, std::move(fail_motor),
             std::move(failed_motor), whole_frame, estimates},
            progress);
      },
      py::arg("recording"), py::kw_only(), py::arg("robot"), py::arg("read_as"), py::arg("topics"),
      py::arg("estimator_robot"), py::arg("options"), py::arg("register"), py::arg("mounting"),
      py::arg("occlude"), py::arg("fail_motor"), py::arg("failed_motor"), py::arg("whole_frame"),
      py::arg("estimates"), py::arg("progress"));
}

}  // namespace capstan::python
