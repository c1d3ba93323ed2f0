#include "app/cli/command.h"
#include "app/cli/study_cramer_rao.h"
#include "app/cli/study_filter.h"
#include "app/cli/study_latency.h"
#include "app/cli/study_monte_carlo.h"
#include "app/cli/study_motor_failure.h"

/// `capstan-cli study NAME`: Monte-Carlo studies of the method, not of a recording. Each file study_*.cpp
/// holds one study and adds its subcommand to `study`.
namespace capstan::cli {

void addStudy(CLI::App& app, ExitCode& exit) {
  CLI::App* study =
      app.add_subcommand("study", "Monte-Carlo studies of the method itself, on the simulated robot");
  study->require_subcommand(1);
  addMonteCarloStudy(*study, exit);
  addCramerRaoStudy(*study, exit);
  addMotorFailureStudy(*study, exit);
  addLatencyStudy(*study, exit);
  addFilterStudy(*study, exit);
}

}  // namespace capstan::cli
