#include <memory>

#include "app/cli/command.h"
#include "app/cli/diagnose_run.h"
#include "app/cli/recordings.h"
#include "app/cli/shard_option.h"
#include "core/recording/recording_kinds.h"

namespace capstan::cli {

void addDiagnose(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app.add_subcommand(
      "diagnose",
      "Find where a robot model disagrees with recordings, the causes, and how much modelling them helps");
  command
      ->add_option("REC", arguments->files,
                   "recordings of one robot: " + recording::recordingKinds() +
                       ";\nor one table of tip poses (columns traj, t_cam_s, cam_x …)")
      ->required();
  command->add_option("--robot", arguments->robot, "nominal robot file; a session contains its own");
  addReadAs(*command, arguments->read_as);
  command->add_option("--only", arguments->options.only, "effects to consider, by their names in robot files")
      ->delimiter(',');
  command
      ->add_option("--effort", arguments->options.effort,
                   "multiplies the limit of the search for causes; 1 is enough for most arms of three joints")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 1e6));
  command
      ->add_option(
          "--towards", arguments->towards,
          "for tip poses: compare the observed poses with the robot's kinematics or with the commands\n"
          "(default: kinematics, if the table has it)")
      ->check(CLI::IsMember({"kinematics", "command"}));
  command
      ->add_option("--skip-start", arguments->skip_start,
                   "initial time of each recording that is simulated but not compared [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  command
      ->add_option(
          "--zeros", arguments->zeros,
          "zeros of joint encoders. known: as in the robot file; shared: one unknown zero for all\n"
          "recordings (for loads that are constant within each); each: one unknown zero per recording\n"
          "(default; with a single recording: known)")
      ->check(CLI::IsMember({"known", "shared", "each"}));
  command->add_option(
      "--material", arguments->material,
      "smallest displacement of a joint that makes an effect a cause; for tables of tip poses: ten times\n"
      "this length at the tip (default " +
          diagnosis::formatTolerance({}) + ")");
  command->add_option("--threads", arguments->options.threads, "number of worker threads")
      ->capture_default_str()
      ->check(CLI::Range(1, 64));
  command->add_option("--seed", arguments->options.seed, "random seed of the bootstraps")
      ->capture_default_str();
  command->add_flag_callback(
      "--no-filter", [arguments] { arguments->options.filter = false; },
      "do not compute how much the error of the Kalman filter falls with the extended robot");
  command->add_option("--out", arguments->out,
                      "extended robot file to write, for simulator, identification and filter");
  command->add_option(
      "--next", arguments->next,
      "trajectory to write (.csv for simulate --trajectory): the motion that best distinguishes\n"
      "the most probable causes, if the verdict is tie or unexplained (cable drives only)");
  command->add_option(
      "--report", arguments->report,
      "folder (new, empty, or of a former run) for a page with figures, the JSON and the robot file");
  command->add_option("--json", arguments->json, "result as JSON, SI: a file, or - for standard output");
  refuseShardOption(*command, "is not for diagnosis, which explains all recordings by one model");
  command->footer(
      "The nominal model is refitted first, so that a mistuned number is not reported as a missing effect.\n"
      "The reference is the joint encoders, or without them the tip position from the cameras. Verdicts:\n"
      "found, several, tie, nothing, unexplained.\n"
      "Each verdict has exit code 0.\n"
      "Examples:\n"
      "  capstan-cli diagnose trial.capstan\n"
      "  capstan-cli diagnose slow.csv fast.csv --robot arm.yaml --report diagnosis --out arm_extended.yaml\n"
      "  capstan-cli diagnose trial.capstan --only backlash,cable_hysteresis --json -\n"
      "  capstan-cli diagnose trial.capstan --next next.csv   # then record it and diagnose both");
  command->callback([arguments, &exit] { exit = runDiagnose(*arguments); });
}

}  // namespace capstan::cli
