#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/identify_drive.h"
#include "app/cli/identify_run.h"
#include "app/python/native/json.h"
#include "app/python/native/module.h"
#include "app/python/native/sources.h"
#include "app/python/native/work.h"
#include "core/base/same_recording.h"
#include "core/identification/drive_recording.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// Trace of the dual UKF: values ± standard deviations over time, one column per parameter.
struct TraceColumns {
  std::vector<std::string> names;
  std::vector<double> t, values, sigmas;
};

struct Identification {
  nlohmann::json document;
  TraceColumns trace;
  std::string robot, tracking;  ///< texts of files; empty: none
  std::vector<std::string> notices;
};

void refuseRepeats(const std::vector<TableInput>& recordings) {
  refuseRepeatedArrays(recordings);
  for (std::size_t i = 0; i < recordings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (recordings[i].isFile() && recordings[j].isFile() &&
          base::sameRecording(recordings[j].name(), recordings[i].name()))
        cli::refuseFile(recordings[i].name(),
                        "is the same recording as " + recordings[j].name() + ": it would count twice",
                        "Give each recording once");
}

TraceColumns traceOf(const cli::Findings& found) {
  TraceColumns columns;
  if (!found.identified->dual) return columns;
  const identification::ParameterSet& set = found.identified->set;
  for (const auto& parameter : set.all()) columns.names.push_back(parameter.name());
  for (const auto& point : found.identified->dual->trace) {
    columns.t.push_back(point.t);
    for (int i = 0; i < set.size(); ++i) {
      const double value = set.value(i, point.log(i));
      columns.values.push_back(value);
      columns.sigmas.push_back(value * point.sigma(i));
    }
  }
  return columns;
}

std::vector<std::string> fileNames(const std::vector<TableInput>& recordings) {
  std::vector<std::string> names;
  for (const TableInput& one : recordings)
    names.push_back(std::filesystem::path(one.name()).filename().string());
  return names;
}

Identification identify(const std::vector<TableInput>& recordings, const cli::IdentifyMethods& methods,
                        const recording::ReadAs& read_as, base::Progress& progress) {
  Identification result;
  cli::CollectedRecordings all;
  for (const TableInput& one : recordings) {
    const auto source = openSource(one, isSession(one) ? "" : methods.robot, read_as);
    const auto& notices = source->info().notices;
    result.notices.insert(result.notices.end(), notices.begin(), notices.end());
    all.add(*source, one.name(), progress);
  }
  const auto found = cli::identifyCollected(all, methods, progress);
  if (!found) return result;  // cancelled
  result.document = cli::documentOf(*found);
  result.trace = traceOf(*found);
  if (const std::string words = cli::excludedWords(*found); !words.empty()) result.notices.push_back(words);
  const experiments::Choice& choice = found->identified->choice;
  if (!choice.method) {
    result.notices.push_back("nothing was identified: " + choice.words);
  } else {
    if (!choice.words.empty()) result.notices.push_back(choice.words);
    if (!methods.exact_camera) result.tracking = cli::trackingOptionsText(*found);
    if (found->identified->anySeen())
      result.robot = cli::identifiedRobotText(*found, fileNames(recordings));
    else
      result.notices.emplace_back("no parameter is observable in this motion");
  }
  return result;
}

/// Options of a robot of one joint.
struct DriveInput {
  std::vector<TableInput> held_out;
  std::string offsets, parameters;
};

std::vector<identification::DriveRecording> driveRecordings(const std::vector<TableInput>& tables,
                                                            const robot::Description& robot,
                                                            const recording::ReadAs& read_as, double step) {
  std::vector<identification::DriveRecording> all;
  for (const TableInput& table : tables)
    all.push_back(identification::driveRecording(readTable(table, robot, read_as), step));
  return all;
}

Identification identifyDrive(const std::vector<TableInput>& recordings, const robot::Description& robot,
                             const DriveInput& input, const recording::ReadAs& read_as,
                             base::Progress& progress) {
  cli::IdentifyDriveArguments arguments;
  arguments.files = namesOf(recordings);
  arguments.held_out = namesOf(input.held_out);
  arguments.parameters = input.parameters;
  arguments.offsets = input.offsets;
  const double step = cli::driveOptionsOf(arguments).step;
  const auto training = driveRecordings(recordings, robot, read_as, step);
  const auto held_out = driveRecordings(input.held_out, robot, read_as, step);
  Identification result;
  const auto found = cli::driveFindings(arguments, robot, training, held_out, progress);
  if (!found) return result;  // cancelled
  result.document = {{"drive", jsonOf(*found)}};
  const auto& estimates = found->report.estimates;
  if (found->report.end == identification::BatchEnd::kFailed)
    result.notices.emplace_back("nothing was identified: the solution did not converge on finite numbers");
  else if (std::ranges::none_of(estimates, [](const auto& e) { return e.seen; }))
    result.notices.emplace_back("no parameter is observable in this motion");
  else
    result.robot = cli::identifiedRobotText(robot, *found, training);
  return result;
}

py::dict toPython(Identification&& found) {
  py::dict trace;
  const int parameters = static_cast<int>(found.trace.names.size());
  trace["names"] = found.trace.names;
  trace["t"] = arrayOf(std::move(found.trace.t));
  trace["value"] = rowsOf(std::move(found.trace.values), std::max(1, parameters));
  trace["sigma"] = rowsOf(std::move(found.trace.sigmas), std::max(1, parameters));
  py::dict result;
  result["report"] = documentToPython(std::move(found.document));
  result["trace"] = parameters > 0 ? py::object(trace) : py::object(py::none());
  result["robot"] = found.robot;
  result["tracking"] = found.tracking;
  result["notices"] = found.notices;
  return result;
}

}  // namespace

void addIdentify(py::module_& module) {
  module.attr("default_parameters") = identification::kDefaultParameters;
  module.def(
      "identify",
      [](const py::list& given, const std::string& robot, const std::string& read_as,
         const std::string& method, const std::string& parameters, const std::string& options,
         bool exact_camera, int threads, const py::list& held_out, const std::string& offsets,
         const py::object& progress) {
        const std::vector<TableInput> recordings = tableInputs(given);
        DriveInput drive{tableInputs(held_out), offsets, parameters.empty() ? "all" : parameters};
        refuseRepeats(recordings);
        std::optional<robot::Description> description;
        if (!robot.empty()) description = robot::readDescriptionOrDefault(robot);
        const recording::ReadAs units = readAsOf(read_as);
        if (description && description->size() == 1) {
          std::vector<TableInput> all = recordings;
          all.insert(all.end(), drive.held_out.begin(), drive.held_out.end());
          refuseRepeats(all);
          return toPython(cancellable(progress, [&](base::Progress& p) {
            return identifyDrive(recordings, *description, drive, units, p);
          }));
        }
        if (!drive.held_out.empty())
          cli::refuseOption("held_out", {}, "is for a robot of one joint",
                            "Give its robot file with robot, or leave it out");
        cli::IdentifyMethods methods{.robot = robot,
                                     .method = method,
                                     .options = options,
                                     .threads = threads,
                                     .exact_camera = exact_camera};
        if (!parameters.empty()) methods.parameters = parameters;
        return toPython(cancellable(
            progress, [&](base::Progress& p) { return identify(recordings, methods, units, p); }));
      },
      py::arg("recordings"), py::kw_only(), py::arg("robot"), py::arg("read_as"), py::arg("method"),
      py::arg("parameters"), py::arg("options"), py::arg("exact_camera"), py::arg("threads"),
      py::arg("held_out"), py::arg("offsets"), py::arg("progress"));
}

}  // namespace capstan::python
