#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <regex>
#include <string>

#include "app/cli/command.h"
#include "app/cli/libraries.h"
#include "app/numbers.h"
#include "core/base/error.h"
#include "core/math/dense.h"

namespace {

constexpr const char* kAbout =
    "Capstan: joint angles of cable-driven surgical robots from motors and cameras.\n"
    "Exit codes: 0 done; 1 no result or a negative one (cancelled, not calibrated, model has drifted);\n"
    "2 bad argument or file; 3 of `recover`: something is lost.";

void refuseUnknownCommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string names;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() == argv[1]) return;
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  throw capstan::base::InputError(
      {{}, 0, {}, {}, std::string("unknown command ") + argv[1], "Commands: " + names});
}

/// Returns "--option = value" if CLI11's `message` reports a value that is not a number, else an empty
/// string. CLI11 reports such a value as out of range where the option has a range.
std::string notANumber(const std::string& message) {
  std::smatch parts;
  if (std::regex_match(message, parts, std::regex("Could not convert: (.*)"))) return parts[1];
  if (!std::regex_match(message, parts, std::regex("(.*): Value (.*) not in range .*"))) return {};
  char* end = nullptr;
  const std::string value = parts[2];
  std::strtod(value.c_str(), &end);
  return end != value.c_str() && *end == '\0' ? std::string() : parts[1].str() + " = " + value;
}

int run(int argc, char** argv) {
  using namespace capstan;
  cli::ExitCode exit = cli::kOk;
  CLI::App app(kAbout, "capstan-cli");
  app.set_version_flag("--version", versionText("capstan-cli", cli::libraries()));
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  cli::addSimulate(app, exit);
  cli::addTrack(app, exit);
  cli::addRecord(app, exit);
  cli::addDevices(app, exit);
  cli::addPlay(app, exit);
  cli::addIdentify(app, exit);
  cli::addDiagnose(app, exit);
  cli::addCompare(app, exit);
  cli::addLearn(app, exit);
  cli::addCorrect(app, exit);
  cli::addDrift(app, exit);
  cli::addExplore(app, exit);
  cli::addExperiment(app, exit);
  cli::addCalibrate(app, exit);
  cli::addRegister(app, exit);
  cli::addRegistrations(app, exit);
  cli::addMarker(app, exit);
  cli::addDetect(app, exit);
  cli::addInfo(app, exit);
  cli::addConvert(app, exit);
  cli::addRecover(app, exit);
  cli::addReport(app, exit);
  cli::addExport(app, exit);
  cli::addFigures(app, exit);
  cli::addStudy(app, exit);
  cli::addMerge(app, exit);
  checkNumbers(app);
  refuseUnknownCommand(app, argc, argv);
  try {
    app.parse(argc, argv);
    return exit;
  } catch (const CLI::ParseError& error) {
    const std::string value = notANumber(error.what());
    if (value.empty()) return app.exit(error) == 0 ? cli::kOk : cli::kUsage;
    throw base::InputError({{}, 0, {}, {}, value + ": is not a number", {}});
  }
}

/// Flushes standard output. Returns `exit`, or at least kFailed if not everything could be written.
int flushed(int exit) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit;
  std::fputs("capstan-cli: standard output could not be written whole. Is the disk full?\n", stderr);
  return std::max<int>(exit, capstan::cli::kFailed);
}

}  // namespace

int main(int argc, char** argv) {
  capstan::math::setDenseThreads(1);  // commands have threads of their own
  try {
    return flushed(run(argc, argv));
  } catch (const capstan::base::InputError& error) {
    std::fprintf(stderr, "capstan-cli: %s\n", error.what());
    return capstan::cli::kUsage;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "capstan-cli: %s: %s. Check the path and its permissions\n", error.path1().c_str(),
                 error.code().message().c_str());
    return capstan::cli::kUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capstan-cli: %s\n", error.what());
    return capstan::cli::kFailed;
  }
}
