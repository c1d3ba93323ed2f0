#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/registrations_output.h"
#include "core/vision/registration_file.h"

namespace capstan::cli {
namespace {

struct RegistrationsArguments {
  std::string history, robot, chosen, out, json;
  std::vector<std::string> compare;
};

ExitCode run(const RegistrationsArguments& arguments) {
  if (arguments.history.empty() && arguments.compare.empty())
    refuseOption("HISTORY", "", "is missing", "Give the history, or two registration files to --compare");
  if (arguments.chosen.empty() != arguments.out.empty())
    refuseOption("--export", arguments.chosen, "needs --out, and --out needs it", "Give both");
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, {arguments.history, arguments.robot});
  std::vector<registration::HistoryEntry> entries;
  if (!arguments.history.empty()) {
    if (!std::filesystem::exists(arguments.history))
      refuseFile(arguments.history, "there is no such file", "Check the path of the history");
    entries = registration::readHistory(arguments.history);
  }
  const Output output(arguments.json);
  nlohmann::json document = {{"registrations", cli::documentOf(entries)}};
  if (arguments.compare.empty() && arguments.out.empty()) output.text(tableOf(entries));
  if (!arguments.compare.empty()) {
    const auto difference = registration::differenceOf(registrationOf(arguments.compare[0], entries),
                                                       registrationOf(arguments.compare[1], entries),
                                                       robot::readDescriptionOrDefault(arguments.robot));
    output.text(wordsOf(difference) + "\n");
    document["difference"] = cli::documentOf(difference);
  }
  if (!arguments.out.empty())
    vision::writeRegistration(registrationOf(arguments.chosen, entries), arguments.out);
  output.json(document);
  return kOk;
}

}  // namespace

void addRegistrations(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<RegistrationsArguments>();
  CLI::App* command =
      app.add_subcommand("registrations", "List, compare and export the registrations of a history");
  command->add_option("HISTORY", arguments->history,
                      "history of the window (registrations.yaml) or of register --history");
  command
      ->add_option("--compare", arguments->compare,
                   "two registrations, each a number of the list or a registration file: what changes\n"
                   "when the second replaces the first")
      ->expected(2);
  command->add_option("--export", arguments->chosen, "number of the registration to write to --out");
  command->add_option("--out", arguments->out, "registration file to write (.yaml)");
  command->add_option("--robot", arguments->robot,
                      "robot file (.yaml), for the workspace of --compare (default: the left RAVEN-II)");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli registrations registrations.yaml\n"
      "  capstan-cli registrations registrations.yaml --compare 1 4\n"
      "  capstan-cli registrations registrations.yaml --export 4 --out registration.yaml");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
