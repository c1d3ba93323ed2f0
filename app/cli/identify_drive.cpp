#include "app/cli/identify_drive.h"

#include <algorithm>
#include <filesystem>

#include "app/cli/console.h"
#include "app/cli/identify_drive_output.h"
#include "app/cli/identify_output.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/base/same_recording.h"
#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/experiments/identified.h"

namespace capstan::cli {
namespace {

using identification::DriveRecording;
using identification::OffsetRule;

std::vector<DriveRecording> readAll(const std::vector<std::string>& files,
                                    const IdentifyDriveArguments& arguments,
                                    const robot::Description& nominal, double step) {
  std::vector<DriveRecording> all;
  for (const std::string& file : files) {
    if (detectFormat(file) != RecordingFormat::kTable)
      refuseFile(file, "is no measured table, which a robot of one joint needs",
                 "Give CSV files with the columns t, q_m1, tau_m1, q1, tau_ext1");
    all.push_back(identification::driveRecording(
        readTable(file, RecordingFormat::kTable, nominal, arguments.read_as), step));
  }
  return all;
}

/// Refuses a recording that is given twice, or for training and held out. Throws base::InputError.
void checkRepeats(const IdentifyDriveArguments& arguments) {
  std::vector<std::string> all = arguments.files;
  all.insert(all.end(), arguments.held_out.begin(), arguments.held_out.end());
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (all[j] != all[i] && !base::sameRecording(all[j], all[i])) continue;
      if (j < arguments.files.size() && i >= arguments.files.size())
        refuseOption("--held-out", all[i], "is also a recording to identify from", "Leave one of them out");
      refuseFile(all[i], "is the same recording as " + all[j] + ": it would count twice",
                 "Give each recording once");
    }
}

DriveFindings judge(const IdentifyDriveArguments& arguments, const robot::Description& nominal,
                    const std::vector<DriveRecording>& training, const std::vector<DriveRecording>& held_out,
                    const identification::DriveOptions& options, identification::DriveReport report) {
  const OffsetRule rule = options.offsets;
  DriveFindings findings{std::move(report), rule, arguments.files, arguments.held_out, {}, {}, {}, false};
  findings.sliding = nominal.joints.front().type == robot::JointType::kPrismatic;
  const auto line = [&](const char* key, const char* words, const identification::LinearDrive& linear) {
    findings.scores.push_back({key, words,
                               scoreLinear(linear, training, rule, identification::DriveOptions::kSkip),
                               scoreLinear(linear, held_out, rule, identification::DriveOptions::kSkip)});
  };
  findings.gear = fitLinear(training, false, rule, identification::DriveOptions::kSkip);
  findings.stretch = fitLinear(training, true, rule, identification::DriveOptions::kSkip);
  line("before", "robot file's gear ratio",
       nominalLine(nominal, training, rule, identification::DriveOptions::kSkip));
  line("gear", "gear ratio, fitted", findings.gear);
  line("stretch", "and linear stretch, fitted", findings.stretch);
  findings.scores.push_back(
      {"cable", "cable model, identified",
       scoreDrive(findings.report.robot, training, rule, identification::DriveOptions::kSkip),
       scoreDrive(findings.report.robot, held_out, rule, identification::DriveOptions::kSkip)});
  return findings;
}

}  // namespace

std::string identifiedRobotText(const robot::Description& nominal, const DriveFindings& findings,
                                const std::vector<DriveRecording>& training) {
  experiments::RobotOrigin origin;
  for (const std::string& file : findings.training)
    origin.recordings.push_back(std::filesystem::path(file).filename().string());
  for (const DriveRecording& recording : training)
    if (!recording.t.empty()) origin.duration += recording.t.back() - recording.t.front();
  origin.method = "output-error";
  origin.values = valueLines(findings.report.estimates);
  origin.software = base::software();
  return experiments::identifiedRobotText(nominal, findings.report.robot, origin);
}

identification::DriveOptions driveOptionsOf(const IdentifyDriveArguments& arguments) {
  identification::DriveOptions options;
  options.offsets = base::fromName<OffsetRule>(arguments.offsets).value();
  return options;
}

std::optional<DriveFindings> driveFindings(const IdentifyDriveArguments& arguments,
                                           const robot::Description& nominal,
                                           const std::vector<DriveRecording>& training,
                                           const std::vector<DriveRecording>& held_out,
                                           base::Progress& progress) {
  const identification::DriveParameters parameters(nominal, arguments.parameters);
  const identification::DriveOptions options = driveOptionsOf(arguments);
  identification::DriveReport report =
      identification::identifyDrive(training, parameters, options, &progress);
  if (progress.cancelled()) return std::nullopt;
  if (report.end == identification::BatchEnd::kNoData)
    refuseFile(arguments.files.front(), "has no joint encoder reading after its first second",
               "Give a longer recording with q1");
  return judge(arguments, nominal, training, held_out, options, std::move(report));
}

ExitCode identifyDrive(const IdentifyDriveArguments& arguments, const robot::Description& nominal) {
  checkRepeats(arguments);
  std::vector<std::string> inputs = arguments.files;
  inputs.insert(inputs.end(), arguments.held_out.begin(), arguments.held_out.end());
  inputs.push_back(arguments.robot);
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, inputs);
  const double step = driveOptionsOf(arguments).step;
  const std::vector<DriveRecording> training = readAll(arguments.files, arguments, nominal, step);
  const std::vector<DriveRecording> held_out = readAll(arguments.held_out, arguments, nominal, step);
  std::optional<DriveFindings> found;
  {
    base::Progress progress;
    const ProgressLine line(progress);
    found = driveFindings(arguments, nominal, training, held_out, progress);
  }
  if (!found) {
    notice("cancelled: nothing was identified");
    return kFailed;
  }
  const DriveFindings& findings = *found;
  const Output output(arguments.json);
  output.text(textOf(findings));
  output.json({{"drive", jsonOf(findings)}});
  const std::string not_written = arguments.out.empty() ? "" : "; not written: " + arguments.out;
  if (findings.report.end == identification::BatchEnd::kFailed) {
    notice("nothing was identified: the solution did not converge on finite numbers" + not_written);
    return kFailed;
  }
  const auto& estimates = findings.report.estimates;
  if (std::none_of(estimates.begin(), estimates.end(), [](const auto& e) { return e.seen; })) {
    notice("no parameter is observable in this motion" + not_written);
    return kFailed;
  }
  if (!arguments.out.empty())
    base::writeTextFile(arguments.out, identifiedRobotText(nominal, findings, training));
  return kOk;
}

}  // namespace capstan::cli
