#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "app/cli/track_output.h"
#include "core/analysis/alignment.h"
#include "core/analysis/rerun.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/recording/recording_kinds.h"
#include "core/tracking/transmission_text.h"

namespace capstan::cli {
namespace {

struct CompareArguments {
  std::string first, second, read_as, json, filter, one_camera;
  std::string robot, options;
  std::optional<double> gate, delay_ms;
};

/// A recording as it was tracked here.
struct Tracked {
  std::string file, words;  ///< words: what is different from the recording; empty: nothing
  tracking::SourceInfo info;
  tracking::TrackReport report;
  analysis::MotionSeries motion;
};

analysis::RerunChange changeOf(const CompareArguments& arguments) {
  analysis::RerunChange change;
  change.robot = arguments.robot;
  change.options = arguments.options;
  change.filter = base::fromName<tracking::FilterKind>(arguments.filter);
  change.one_camera = base::fromName<tracking::OneCamera>(arguments.one_camera);
  change.gate_probability = arguments.gate;
  if (arguments.delay_ms) change.camera_delay = 1e-3 * *arguments.delay_ms;
  return change;
}

Tracked tracked(const std::string& file, const CompareArguments& arguments,
                const analysis::RerunChange& change, base::Progress& progress) {
  const ProgressLine line(progress);
  const auto source = openSource(file, detectFormat(file), {}, readAsOf(arguments.read_as));
  Tracked result{file, change.words(), source->info(), {}, {}};
  result.report =
      analysis::rerun(*source, result.info, change, progress, [&](const tracking::Snapshot& snapshot) {
        if (snapshot.motor_updated) result.motion.add(snapshot);
      });
  result.info = analysis::rerunSetup(result.info, change).info;
  return result;
}

std::string nameOf(const Tracked& one) { return one.file + (one.words.empty() ? "" : " with " + one.words); }

std::string alignmentText(const std::optional<analysis::Alignment>& found) {
  if (!found) return "alignment      none: a recording is at rest or shorter than 2 s\n";
  if (!found->same())
    return fmt::format("alignment      none: the motions differ (correlation {:.2f} at best)\n",
                       found->correlation);
  return fmt::format(
      "alignment      time in the second = time in the first {:+.3f} s, {:.1f} s in common, correlation "
      "{:.3f}{}\n",
      found->offset, found->overlap, found->correlation,
      found->clear()
          ? ""
          : fmt::format("; not clear: {:.3f} at another offset, the motion repeats", found->second_best));
}

std::string rowText(const char* name, const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  std::string text;
  for (int joint = 0; joint < 3; ++joint) {
    const double a = tracking::forPeople(first(joint), joint), b = tracking::forPeople(second(joint), joint);
    text +=
        fmt::format("{:<12}q{}  {:>10.4f} {:>10.4f} {:>+10.4f} {:>8}  {}\n", joint == 0 ? name : "",
                    joint + 1, a, b, b - a, a > 0.0 ? fmt::format("{:+.1f} %", 100.0 * (b / a - 1.0)) : "-",
                    tracking::kJointUnits[static_cast<std::size_t>(joint)]);
  }
  return text;
}

std::string comparisonText(const Tracked& first, const Tracked& second) {
  std::string text = fmt::format("first          {}\nsecond         {}\n\n", nameOf(first), nameOf(second));
  text += fmt::format("{:<12}    {:>10} {:>10} {:>10}\n", "RMS error", "first", "second", "difference");
  const auto &a = first.report, &b = second.report;
  text += rowText("kinematic", a.errors.kinematic().value(), b.errors.kinematic().value());
  text += rowText("camera", a.errors.camera().value(), b.errors.camera().value());
  text += rowText("UKF", a.errors.ukf().value(), b.errors.ukf().value());
  text += fmt::format("\n{:<16}{:>10.3f} {:>10.3f}\n", "NIS / 3", a.nisMean(), b.nisMean());
  if (a.nees_count > 0 && b.nees_count > 0)
    text += fmt::format("{:<16}{:>10.3f} {:>10.3f}\n", "NEES / 3", a.neesMean(), b.neesMean());
  for (const auto* one : {&first, &second})
    for (const std::string& line : tracking::linesOf(one->report.transmission))
      text += fmt::format("{:<15}{}\n", one == &first ? "first found" : "second found", line);
  return text;
}

nlohmann::json alignmentJson(const std::optional<analysis::Alignment>& found) {
  if (!found) return {};
  return {{"offset", found->offset},           {"correlation", found->correlation},
          {"second_best", found->second_best}, {"overlap", found->overlap},
          {"same_motion", found->same()},      {"clear", found->clear()}};
}

nlohmann::json trackedJson(const Tracked& one) {
  nlohmann::json document = cli::jsonOf(one.report, one.info);
  document["file"] = one.file;
  document["changed"] = one.words;
  return document;
}

ExitCode compare(const CompareArguments& arguments) {
  const analysis::RerunChange change = changeOf(arguments);
  if (arguments.second.empty() && change.empty())
    refuseOption("SECOND", {}, "is missing, and nothing else is changed",
                 "Give a second recording, or one of --robot, --options, --filter, --one-camera, --gate, "
                 "--camera-delay-ms");
  checkOutputs({{"--json", arguments.json}},
               {arguments.first, arguments.second, arguments.robot, arguments.options});
  const Output output(arguments.json);
  base::Progress progress;
  const Tracked first = tracked(arguments.first, arguments, {}, progress);
  if (first.report.cancelled) return notice("cancelled"), kFailed;
  const Tracked second =
      tracked(arguments.second.empty() ? arguments.first : arguments.second, arguments, change, progress);
  if (second.report.cancelled) return notice("cancelled"), kFailed;
  std::string text = comparisonText(first, second);
  nlohmann::json document = {
      {"first", trackedJson(first)}, {"second", trackedJson(second)}, {"alignment", nullptr}};
  if (!arguments.second.empty()) {
    const auto found = analysis::alignmentOf(first.motion, second.motion);
    text += alignmentText(found);
    document["alignment"] = alignmentJson(found);
  }
  output.text(text);
  output.json(document);
  const bool nothing = first.report.motor_samples == 0 || second.report.motor_samples == 0;
  if (nothing) notice("a recording holds no motor sample: nothing was compared");
  return nothing ? kFailed : kOk;
}

}  // namespace

void addCompare(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand(
      "compare", "Compare two recordings, or one with itself tracked with another robot or other options");
  command->add_option("FIRST", arguments->first, recording::recordingKinds())->required();
  command->add_option(
      "SECOND", arguments->second,
      "second recording; its time is aligned with the first by the motion; default: FIRST again");
  command->add_option("--robot", arguments->robot, "robot file that the second is tracked with");
  command->add_option("--options", arguments->options, "file of filter options for the second");
  command->add_option("--filter", arguments->filter, "filter of the second: augmented or six_state")
      ->check(CLI::IsMember({"augmented", "six_state"}));
  command
      ->add_option("--one-camera", arguments->one_camera,
                   "while one camera is blocked, in the second: kinematics, or ray of the other one")
      ->check(CLI::IsMember({"kinematics", "ray"}));
  command->add_option("--gate", arguments->gate, "probability of the gate on the innovation, in the second")
      ->check(CLI::Range(0.5, 0.999999));
  command
      ->add_option("--camera-delay-ms", arguments->delay_ms,
                   "time stamp minus exposure of a camera sample, in the second [ms]")
      ->check(CLI::Range(-1000.0, 1000.0));
  addReadAs(*command, arguments->read_as);
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli compare monday.capstan tuesday.capstan\n"
      "  capstan-cli compare trial.capstan --robot my_robot.yaml --json -\n"
      "  capstan-cli compare trial.capstan --filter six_state --gate 0.99");
  command->callback([arguments, &exit] { exit = compare(*arguments); });
}

}  // namespace capstan::cli
