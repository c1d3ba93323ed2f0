#include "app/cli/diagnose_run.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/cli/console.h"
#include "app/cli/diagnose_output.h"
#include "app/cli/diagnose_poses.h"
#include "app/cli/file_drawing.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/base/error.h"
#include "core/base/same_recording.h"
#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/report/extended_robot.h"
#include "core/diagnosis/report/report_json.h"
#include "core/robot/effects.h"
#include "widgets/figures/diagnosis_export.h"

namespace capstan::cli {
namespace {

using diagnosis::Evidence;
using diagnosis::Report;

void checkOptions(const DiagnoseArguments& arguments) {
  if (!arguments.towards.empty())
    refuseOption("--towards", arguments.towards, "is for tables of tip poses", "Leave it out");
  std::string all;
  for (const robot::EffectFacts& facts : robot::effectFacts())
    all += (all.empty() ? "" : ", ") + std::string(facts.name);
  for (const std::string& name : arguments.options.only)
    if (!robot::effectNamed(name)) refuseOption("--only", name, "is no effect", "Effects: " + all);
}

/// Recordings that are each another, and outputs that can be written and are no inputs.
void checkFiles(const DiagnoseArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (base::sameRecording(files[j], files[i]))
        refuseFile(files[i], "is the same recording as " + files[j] + ": it would count twice",
                   "Give each recording once");
  for (const std::string& file : files)
    if (const RecordingFormat format = detectFormat(file); format == RecordingFormat::kRobot)
      refuseFile(file, "is a robot file and no recording", "Give it as --robot");
    else
      refuseReadAs(file, format, readAsOf(arguments.read_as));
  std::vector<std::string> inputs = files;
  inputs.push_back(arguments.robot);
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, inputs);
  if (arguments.report.empty()) return;
  checkOutputFolder("--report", arguments.report, {"index.html", "report.json", "robot.yaml"}, inputs);
  widgets::checkExportFolder(arguments.report, widgets::kDiagnosisMark);
}

/// Cancelled: those that were read until then.
std::vector<Evidence> readAll(const DiagnoseArguments& arguments, const robot::Description& robot,
                              base::Progress& progress) {
  diagnosis::EvidenceOptions options;
  options.skip_start = arguments.skip_start;
  options.read_as = readAsOf(arguments.read_as);
  std::vector<Evidence> all;
  for (const std::string& file : arguments.files) {
    try {
      all.push_back(diagnosis::readEvidence(file, robot, options, &progress));
    } catch (const base::InputError&) {
      if (!progress.cancelled()) throw;  // what was read until then may hold too little
    }
    if (progress.cancelled()) break;
  }
  return all;
}

/// A report, as people and programs read it.
struct Found {
  Report report;
  std::string text;
  nlohmann::json json;
};

/// None: cancelled before there was anything to say.
std::optional<Found> find(const DiagnoseArguments& arguments, const Diagnose& diagnose,
                          robot::Description& nominal) {
  base::Progress progress;
  const ProgressLine line(progress);
  const std::vector<Evidence> recordings = readAll(arguments, nominal, progress);
  if (progress.cancelled()) return std::nullopt;
  if (arguments.robot.empty() && recordings.front().robot) nominal = *recordings.front().robot;
  diagnosis::DiagnosisOptions options = arguments.options;
  if (const auto zeros = base::fromName<diagnosis::EncoderZeros>(arguments.zeros)) options.zeros = *zeros;
  Report report = diagnose(recordings, nominal, options, &progress);
  if (report.cancelled && report.channels.empty()) return std::nullopt;
  std::string text = textOf(report);
  nlohmann::json json = diagnosis::jsonOf(report);
  return Found{std::move(report), std::move(text), std::move(json)};
}

Found findInPoses(const DiagnoseArguments& arguments, const robot::Description& nominal) {
  diagnosis::PoseReport poses = diagnosePoseTable(arguments, nominal);
  std::string text = textOf(poses.report) + "\n" + plainText(diagnosis::poseStepTable(poses));
  nlohmann::json json = diagnosis::jsonOf(poses);
  return {std::move(poses.report), std::move(text), std::move(json)};
}

void writeRobot(const DiagnoseArguments& arguments, const Report& report) {
  base::writeTextFile(arguments.out, diagnosis::extendedRobotText(report, base::software()));
  if (report.causes.empty()) notice("nothing was named: " + arguments.out + " is the refitted robot");
}

/// False: cancelled while it was drawn.
bool writePage(const DiagnoseArguments& arguments, const Report& report, const robot::Description& nominal) {
  const FileDrawing drawing;
  base::Progress progress;
  const ProgressLine line(progress);
  widgets::exportDiagnosis(report, {nominal.name, base::software(), isoNow()}, arguments.report, &progress);
  return !progress.cancelled();
}

/// Says what was not written.
ExitCode cancelled(const DiagnoseArguments& arguments, const std::string& what) {
  std::string files;
  for (const std::string& file : {arguments.out, arguments.report})
    if (!file.empty()) files += (files.empty() ? "" : ", ") + file;
  notice("cancelled: " + what + (files.empty() ? "" : "; not written: " + files));
  return kFailed;
}

}  // namespace

ExitCode runDiagnose(const DiagnoseArguments& arguments, const Diagnose& diagnose) {
  const bool poses = arePoses(arguments.files);
  if (!poses) checkOptions(arguments);
  if (poses && !arguments.read_as.empty())
    refuseOption(kReadAs, arguments.read_as, "is not for tables of tip poses", "Leave it out");
  checkFiles(arguments);
  robot::Description nominal = readRobot(arguments.robot);
  const std::optional<Found> found =
      poses ? findInPoses(arguments, nominal) : find(arguments, diagnose, nominal);
  if (!found) return cancelled(arguments, "nothing was diagnosed");
  const Report* report = &found->report;
  for (const std::string& line : report->notices) notice(line);
  const Output output(arguments.json);
  output.text(found->text);
  output.json(found->json);
  if (report->cancelled) return cancelled(arguments, "this is what there was until then");
  if (!arguments.out.empty()) writeRobot(arguments, *report);
  if (!arguments.report.empty() && !writePage(arguments, *report, nominal)) {
    notice("cancelled: " + arguments.report + " lacks figures");
    return kFailed;
  }
  if (!arguments.report.empty())
    output.text("report: " + (std::filesystem::path(arguments.report) / "index.html").string() + "\n");
  return kOk;
}

}  // namespace capstan::cli
