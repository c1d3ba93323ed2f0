#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/simulation_arguments.h"
#include "core/base/error.h"
#include "core/recording/export.h"
#include "core/recording/session_file.h"

namespace capstan::cli {
namespace {

struct SimulateArguments {
  std::string out, json;
  bool force = false;
  simulation::SimulationRequest simulation;
};

ExitCode simulate(const SimulateArguments& arguments) {
  const Output output(arguments.json);
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, withFilesOf(arguments.simulation, {}));
  if (std::filesystem::path(arguments.out).extension() != recording::kSessionSuffix)
    refuseOption("--out", arguments.out, "does not end in .capstan",
                 "Give a name with .capstan; `convert` makes a table or a video of it");
  if (!arguments.force) refuseExisting("--out", arguments.out);
  const auto source = makeSimulation(arguments.simulation);
  base::Progress progress;
  {
    const ProgressLine line(progress);
    recording::importRecording(*source, arguments.out, recording::headerOf(source->info(), isoNow()),
                               &progress,
                               arguments.force ? recording::Existing::kReplace : recording::Existing::kRefuse,
                               recording::OnFullDisk::kKeep);
  }
  if (progress.cancelled()) {
    notice("cancelled");
    return kFailed;
  }
  const auto summary = recording::readSessionSummary(arguments.out);
  output.text(fmt::format(
      "{}: {:.3f} s, {} motor samples, {} references, {} pairs of images, {} tip samples, {:.1f} MB\n",
      arguments.out, summary.last_t - summary.first_t, summary.motor, summary.joint, summary.frames,
      summary.tip, 1e-6 * static_cast<double>(summary.bytes)));
  output.json({{"file", arguments.out},
               {"first_t", summary.first_t},
               {"last_t", summary.last_t},
               {"motor", summary.motor},
               {"joint", summary.joint},
               {"frames", summary.frames},
               {"tip", summary.tip},
               {"bytes", summary.bytes},
               {"seed", arguments.simulation.seed}});
  return kOk;
}

}  // namespace

void addSimulate(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = app.add_subcommand("simulate", "Record a session of the simulated robot");
  command->add_option("--out", arguments->out, "session file to write (.capstan)")->required();
  command->add_flag("--force", arguments->force, "overwrite an existing file");
  command->add_option("--robot", arguments->simulation.robot, "robot file; default: the left RAVEN-II");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  addSimulationOptions(*command, arguments->simulation);
  command->footer(
      "Examples:\n"
      "  capstan-cli simulate --out trial.capstan --duration 80 --seed 7\n"
      "  capstan-cli simulate --out matched.capstan --truth matched --trajectory sinusoid --no-images\n"
      "A minute with images takes about 0.8 GB.");
  command->callback([arguments, &exit] { exit = simulate(*arguments); });
}

}  // namespace capstan::cli
