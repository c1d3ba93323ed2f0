#include <fmt/format.h>

#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/live/player.h"
#include "core/recording/export.h"
#include "core/recording/recording_kinds.h"

namespace capstan::cli {
namespace {

struct PlayArguments {
  std::string file, to, robot, read_as, json;
  std::vector<std::string> faults;
  live::PlayOptions options;
};

live::Address target(const std::string& to) {
  const live::Address address = live::parseAddress(to, "--to");
  if (address.kind != live::Address::Kind::kTcp || address.port == 0)
    refuseOption("--to", to, "is no TCP address", "Give one as in tcp://127.0.0.1:5555");
  return address;
}

ExitCode play(PlayArguments& arguments) {
  const live::Address to = target(arguments.to);
  for (const std::string& text : arguments.faults)
    arguments.options.faults.push_back(live::parsePlayFault(text, "--fault"));
  checkOutputs({{"--json", arguments.json}}, {arguments.file, arguments.robot});
  const Output output(arguments.json);
  const RecordingFormat format = detectFormat(arguments.file);
  const recording::MeasuredTable table =
      format == RecordingFormat::kSession
          ? recording::sessionTable(arguments.file)
          : readTable(arguments.file, format, robot::readDescriptionOrDefault(arguments.robot),
                      readAsOf(arguments.read_as));
  base::Progress progress;
  live::PlayReport report;
  {
    const ProgressLine line(progress);
    report = live::playRows(table, to, arguments.options, &progress);
  }
  output.text(fmt::format("{} of {} rows sent to {} in {:.2f} s; {} withheld by faults; {} connection{}\n",
                          report.sent, table.rows(), arguments.to, report.seconds, report.withheld,
                          report.connections, report.connections == 1 ? "" : "s"));
  output.json({{"rows", table.rows()},
               {"sent", report.sent},
               {"withheld", report.withheld},
               {"connections", report.connections},
               {"answer", report.answer.empty() ? nlohmann::json() : nlohmann::json(report.answer)}});
  if (!report.answer.empty()) notice("the receiver answered: " + report.answer);
  if (report.refused) notice("the receiver has ended the connection and does not listen any more");
  return report.refused || progress.cancelled() ? kFailed : kOk;
}

}  // namespace

void addPlay(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<PlayArguments>();
  CLI::App* command =
      app.add_subcommand("play", "Send a recording in real time, as a robot would, with faults on request");
  command->add_option("FILE", arguments->file, recording::recordingKinds())->required();
  command->add_option("--to", arguments->to, "receiver, as in tcp://127.0.0.1:5555; it must listen already")
      ->required();
  command
      ->add_option("--speed", arguments->options.speed,
                   "recording time per wall time; 0: as fast as the receiver takes")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1000.0));
  command
      ->add_option(
          "--fault", arguments->faults,
          "drop:SHARE, repeat:SHARE, jitter:SECONDS (exponential delays of this mean),\n"
          "silence:SECONDS@TIME, freeze:SECONDS@TIME, step:SECONDS@TIME (of the clock) or garbage@TIME;\n"
          "repeatable")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->options.seed, "random seed of the faults")->capture_default_str();
  addReadAs(*command, arguments->read_as);
  command->add_option("--robot", arguments->robot, "robot file, for recordings that contain none");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan --live tcp://127.0.0.1:5555                       (in one terminal)\n"
      "  capstan-cli play trial.capstan --to tcp://127.0.0.1:5555  (in another one)\n"
      "  capstan-cli play trial.csv --to tcp://127.0.0.1:5555 --fault jitter:0.02 --fault silence:2@10");
  command->callback([arguments, &exit] { exit = play(*arguments); });
}

}  // namespace capstan::cli
