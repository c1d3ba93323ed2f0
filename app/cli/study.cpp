#include "app/cli/command.h"
#include "app/cli/study_cramer_rao.h"
#include "app/cli/study_filter.h"
#include "app/cli/study_health.h"
#include "app/cli/study_latency.h"
#include "app/cli/study_monte_carlo.h"
#include "app/cli/study_motor_failure.h"
#include "app/cli/study_one_camera.h"

/// `capstan-cli study NAME`: studies of the method, mostly on simulated robots. Each file study_*.cpp
/// holds one study and adds its subcommand to `study`.
namespace capstan::cli {

void addStudy(CLI::App& app, ExitCode& exit) {
  CLI::App* study = app.add_subcommand(
      "study", "Studies of the method itself, mostly Monte-Carlo studies on simulated robots");
  study->require_subcommand(1);
  addMonteCarloStudy(*study, exit);
  addCramerRaoStudy(*study, exit);
  addMotorFailureStudy(*study, exit);
  addLatencyStudy(*study, exit);
  addFilterStudy(*study, exit);
  addOneCameraStudy(*study, exit);
  addHealthStudy(*study, exit);
}

}  // namespace capstan::cli
