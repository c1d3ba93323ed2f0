#include "app/cli/diagnose_run.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/cli/console.h"
#include "app/cli/diagnose_output.h"
#include "app/cli/file_drawing.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/base/error.h"
#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/report/extended_robot.h"
#include "core/robot/effects.h"
#include "widgets/figures/diagnosis_export.h"

namespace capstan::cli {
namespace {

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

/// Refuses options that do not apply to tip poses. Throws base::InputError.
void checkPoseOptions(const DiagnoseArguments& arguments) {
  if (!arguments.read_as.empty())
    refuseOption(kReadAs, arguments.read_as, "is not for tables of tip poses", "Leave it out");
  if (arguments.skip_start > 0.0)
    refuseOption("--skip-start", fmt::format("{}", arguments.skip_start),
                 "is for recordings that are simulated; poses are compared trajectory by trajectory",
                 "Leave it out");
  if (!arguments.next.empty())
    refuseOption("--next", arguments.next, "is for recordings that are simulated", "Leave it out");
  if (!arguments.zeros.empty())
    refuseOption("--zeros", arguments.zeros, "is for recordings with joint encoders; poses have none",
                 "Leave it out");
}

/// Checks that files are recordings, and that outputs can be written and are no inputs.
void checkFiles(const DiagnoseArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  for (const std::string& file : files)
    if (const RecordingFormat format = detectFormat(file); format == RecordingFormat::kRobot)
      refuseFile(file, "is a robot file and no recording", "Give it as --robot");
    else
      refuseReadAs(file, format, readAsOf(arguments.read_as));
  std::vector<std::string> inputs = files;
  inputs.push_back(arguments.robot);
  checkOutputs({{"--out", arguments.out}, {"--next", arguments.next}, {"--json", arguments.json}}, inputs);
  if (arguments.report.empty()) return;
  checkOutputFolder("--report", arguments.report, {"index.html", "report.json", "robot.yaml"}, inputs);
  widgets::checkExportFolder(arguments.report, widgets::kDiagnosisMark);
}

diagnosis::DiagnosisRequest requestOf(const DiagnoseArguments& arguments) {
  diagnosis::DiagnosisRequest request{.files = arguments.files, .robot = arguments.robot};
  request.evidence.skip_start = arguments.skip_start;
  request.evidence.read_as = readAsOf(arguments.read_as);
  request.options = arguments.options;
  if (!arguments.material.empty())
    request.options.material = diagnosis::parseTolerance(arguments.material, "--material");
  if (const auto zeros = base::fromName<diagnosis::EncoderZeros>(arguments.zeros))
    request.options.zeros = *zeros;
  request.towards = base::fromName<diagnosis::PoseReference>(arguments.towards);
  return request;
}

std::string wordsOf(const diagnosis::FilesDiagnosis& found) {
  std::string text = textOf(found.report());
  if (const auto* poses = std::get_if<diagnosis::PoseReport>(&found.found))
    text += "\n" + plainText(diagnosis::poseStepTable(*poses));
  return text;
}

diagnosis::FilesDiagnosis diagnosed(const diagnosis::DiagnosisRequest& request,
                                    const diagnosis::Diagnose& diagnose) {
  base::Progress progress;
  const ProgressLine line(progress);
  return diagnosis::diagnoseFiles(request, progress, diagnose);
}

void writeRobot(const DiagnoseArguments& arguments, const Report& report) {
  base::writeTextFile(arguments.out, diagnosis::extendedRobotText(report, base::software()));
  if (report.causes.empty()) notice("nothing was named: " + arguments.out + " is the refitted robot");
}

void writeNext(const DiagnoseArguments& arguments, const Report& report) {
  if (report.next)
    base::writeTextFile(arguments.next, diagnosis::trajectoryText(*report.next));
  else
    notice("no experiment is proposed: " + arguments.next + " was not written");
}

/// Writes the page of --report. Returns false if it was cancelled while figures were drawn.
bool writePage(const DiagnoseArguments& arguments, const Report& report, const robot::Description& nominal) {
  const FileDrawing drawing;
  base::Progress progress;
  const ProgressLine line(progress);
  widgets::exportDiagnosis(report, {nominal.name, base::software(), isoNow()}, arguments.report, &progress);
  return !progress.cancelled();
}

/// Prints a notice of the cancellation with the files that were not written. Returns kFailed.
ExitCode cancelled(const DiagnoseArguments& arguments, const std::string& what) {
  std::string files;
  for (const std::string& file : {arguments.out, arguments.next, arguments.report})
    if (!file.empty()) files += (files.empty() ? "" : ", ") + file;
  notice("cancelled: " + what + (files.empty() ? "" : "; not written: " + files));
  return kFailed;
}

}  // namespace

ExitCode runDiagnose(const DiagnoseArguments& arguments, const diagnosis::Diagnose& diagnose) {
  if (diagnosis::arePoseTables(arguments.files))
    checkPoseOptions(arguments);
  else
    checkOptions(arguments);
  checkFiles(arguments);
  const diagnosis::FilesDiagnosis found = diagnosed(requestOf(arguments), diagnose);
  const Report& report = found.report();
  if (report.cancelled && report.channels.empty()) return cancelled(arguments, "nothing was diagnosed");
  for (const std::string& line : report.notices) notice(line);
  const Output output(arguments.json);
  output.text(wordsOf(found));
  output.json(jsonOf(found));
  if (report.cancelled) return cancelled(arguments, "these are the results until then");
  if (!arguments.out.empty()) writeRobot(arguments, report);
  if (!arguments.next.empty()) writeNext(arguments, report);
  if (!arguments.report.empty() && !writePage(arguments, report, found.nominal)) {
    notice("cancelled: " + arguments.report + " lacks figures");
    return kFailed;
  }
  if (!arguments.report.empty())
    output.text("report: " + (std::filesystem::path(arguments.report) / "index.html").string() + "\n");
  return kOk;
}

}  // namespace capstan::cli
