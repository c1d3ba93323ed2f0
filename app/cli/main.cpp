#include <cstdio>
#include <exception>

#include "app/cli/command.h"
#include "core/base/error.h"

namespace {

constexpr const char* kAbout =
    "Capstan: joint angles of cable-driven surgical robots from motors and cameras.\n"
    "Exit codes: 0 done, 1 the answer is no or the run failed, 2 bad argument or file.";

int run(int argc, char** argv) {
  using namespace capstan;
  cli::ExitCode exit = cli::kOk;
  CLI::App app(kAbout, "capstan-cli");
  app.set_version_flag("--version", CAPSTAN_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  cli::addSimulate(app, exit);
  cli::addTrack(app, exit);
  cli::addIdentify(app, exit);
  cli::addCalibrate(app, exit);
  cli::addInfo(app, exit);
  cli::addConvert(app, exit);
  cli::addReport(app, exit);
  try {
    app.parse(argc, argv);
    return exit;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cli::kOk : cli::kUsage;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const capstan::base::InputError& error) {
    std::fprintf(stderr, "capstan-cli: %s\n", error.what());
    return capstan::cli::kUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capstan-cli: %s\n", error.what());
    return capstan::cli::kFailed;
  }
}
