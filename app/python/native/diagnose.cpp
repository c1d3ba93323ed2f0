#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/recordings.h"
#include "app/python/native/json.h"
#include "app/python/native/module.h"
#include "app/python/native/sources.h"
#include "app/python/native/work.h"
#include "core/base/software.h"
#include "core/diagnosis/diagnose_files.h"
#include "core/diagnosis/evidence/pose_evidence.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/report/extended_robot.h"

namespace capstan::python {
namespace {

namespace py = pybind11;
using diagnosis::DiagnosisRequest;
using diagnosis::FilesDiagnosis;

/// Options as Python gives them; empty texts and lists: not given.
struct DiagnoseOptions {
  std::string robot, read_as, towards, zeros, material;
  std::vector<std::string> only;
  double effort = 1.0, skip_start = 0.0;
  int threads = 2;
  std::uint64_t seed = 1;
  bool filter = true;
};

DiagnosisRequest requestOf(const std::vector<TableInput>& recordings, const DiagnoseOptions& options) {
  DiagnosisRequest request{.files = namesOf(recordings), .robot = options.robot};
  request.evidence.skip_start = options.skip_start;
  request.evidence.read_as = readAsOf(options.read_as);
  request.options.only = options.only;
  request.options.effort = options.effort;
  request.options.threads = options.threads;
  request.options.seed = options.seed;
  request.options.filter = options.filter;
  if (!options.material.empty())
    request.options.material = diagnosis::parseTolerance(options.material, "material");
  if (const auto zeros = base::fromName<diagnosis::EncoderZeros>(options.zeros))
    request.options.zeros = *zeros;
  request.towards = base::fromName<diagnosis::PoseReference>(options.towards);
  return request;
}

bool arePoses(const std::vector<TableInput>& recordings, bool files) {
  if (files) return diagnosis::arePoseTables(namesOf(recordings));
  for (const TableInput& one : recordings)
    if (diagnosis::isPoseTable(one.columnNames())) {
      if (recordings.size() == 1) return true;
      cli::refuseFile(one.name(), "is a table of tip poses among other recordings", "Diagnose it by itself");
    }
  return false;
}

/// Refuses options of the other kind of recordings.
void check(const DiagnoseOptions& options, bool poses) {
  const auto refuse = [&](const char* name, const std::string& value, bool for_poses) {
    if (value.empty() || poses == for_poses) return;
    cli::refuseOption(name, value,
                      for_poses ? "is for tables of tip poses" : "is not for tables of tip poses",
                      "Leave it out");
  };
  refuse("towards", options.towards, true);
  refuse("read_as", options.read_as, false);
  refuse("zeros", options.zeros, false);
  refuse("skip_start", options.skip_start > 0.0 ? std::to_string(options.skip_start) : "", false);
}

FilesDiagnosis diagnosePoseArrays(const TableInput& table, const DiagnosisRequest& request,
                                  base::Progress& progress) {
  robot::Description nominal = robot::readDescriptionOrDefault(request.robot);
  diagnosis::PoseOptions options;
  options.towards = request.towards;
  options.only = request.options.only;
  options.seed = request.options.seed;
  options.material = request.options.material;
  auto report = diagnosis::diagnosePoses(diagnosis::readPoseEvidence(table.columns(), table.name()), nominal,
                                         options, &progress);
  return {std::move(nominal), std::move(report)};
}

FilesDiagnosis diagnoseArrays(const std::vector<TableInput>& tables, const DiagnosisRequest& request,
                              base::Progress& progress) {
  refuseRepeatedArrays(tables);
  robot::Description nominal = robot::readDescriptionOrDefault(request.robot);
  std::vector<diagnosis::Evidence> evidence;
  for (const TableInput& table : tables)
    evidence.push_back(diagnosis::evidenceOf(readTable(table, nominal, request.evidence.read_as), nominal,
                                             request.evidence));
  diagnosis::Report report = diagnosis::diagnose(evidence, nominal, request.options, &progress);
  return {std::move(nominal), std::move(report)};
}

py::object nextToPython(const diagnosis::Report& report) {
  if (!report.next) return py::none();
  py::dict next;
  next["t"] = arrayOf(std::vector<double>(report.next->t));
  for (std::size_t i = 0; i < report.next->q.size(); ++i)
    next[py::str("q" + std::to_string(i + 1))] = arrayOf(std::vector<double>(report.next->q[i]));
  return next;
}

py::dict diagnose(const py::list& given, const DiagnoseOptions& options, const py::object& progress) {
  const std::vector<TableInput> recordings = tableInputs(given);
  const bool files = areFiles(recordings);
  const bool poses = arePoses(recordings, files);
  check(options, poses);
  for (const TableInput& one : recordings)
    if (one.isFile() && cli::detectFormat(one.name()) == cli::RecordingFormat::kRobot)
      cli::refuseFile(one.name(), "is a robot file and no recording", "Give it as robot");
  const DiagnosisRequest request = requestOf(recordings, options);
  const FilesDiagnosis found = cancellable(progress, [&](base::Progress& p) {
    if (files) return diagnosis::diagnoseFiles(request, p);
    return poses ? diagnosePoseArrays(recordings.front(), request, p)
                 : diagnoseArrays(recordings, request, p);
  });
  const diagnosis::Report& report = found.report();
  py::dict result;
  result["report"] = documentToPython(diagnosis::jsonOf(found));
  result["robot"] = diagnosis::extendedRobotText(report, base::software());
  result["next"] = nextToPython(report);
  result["next_text"] = report.next ? diagnosis::trajectoryText(*report.next) : std::string();
  result["notices"] = report.notices;
  return result;
}

}  // namespace

void addDiagnose(py::module_& module) {
  module.def(
      "diagnose",
      [](const py::list& recordings, std::string robot, std::string read_as, std::string towards,
         std::string zeros, std::string material, std::vector<std::string> only, double effort,
         double skip_start, int threads, std::uint64_t seed, bool filter, const py::object& progress) {
        return diagnose(recordings,
                        {std::move(robot), std::move(read_as), std::move(towards), std::move(zeros),
                         std::move(material), std::move(only), effort, skip_start, threads, seed, filter},
                        progress);
      },
      py::arg("recordings"), py::kw_only(), py::arg("robot"), py::arg("read_as"), py::arg("towards"),
      py::arg("zeros"), py::arg("material"), py::arg("only"), py::arg("effort"), py::arg("skip_start"),
      py::arg("threads"), py::arg("seed"), py::arg("filter"), py::arg("progress"));
}

}  // namespace capstan::python
