#pragma once

#include <CLI/CLI.hpp>

/// capstan-cli: one subcommand per file. A command declares its options on `app`; its callback does the work
/// and stores the exit code in `exit`. Bad arguments and files throw base::InputError, which main() prints.
namespace capstan::cli {

enum ExitCode : int {
  kOk = 0,
  kFailed = 1,      ///< no result or a negative one (not calibrated, nothing tracked, cancelled)
  kUsage = 2,       ///< bad argument, or bad or missing file
  kIncomplete = 3,  ///< of `recover`: rows are lost
};

void addSimulate(CLI::App& app, ExitCode& exit);
void addTrack(CLI::App& app, ExitCode& exit);
void addRecord(CLI::App& app, ExitCode& exit);
void addPlay(CLI::App& app, ExitCode& exit);
void addIdentify(CLI::App& app, ExitCode& exit);
void addExperiment(CLI::App& app, ExitCode& exit);
void addMerge(CLI::App& app, ExitCode& exit);
void addCalibrate(CLI::App& app, ExitCode& exit);
void addRegister(CLI::App& app, ExitCode& exit);
void addRegistrations(CLI::App& app, ExitCode& exit);
void addMarker(CLI::App& app, ExitCode& exit);
void addDetect(CLI::App& app, ExitCode& exit);
void addInfo(CLI::App& app, ExitCode& exit);
void addConvert(CLI::App& app, ExitCode& exit);
void addDevices(CLI::App& app, ExitCode& exit);
void addDiagnose(CLI::App& app, ExitCode& exit);
void addCompare(CLI::App& app, ExitCode& exit);
void addRecover(CLI::App& app, ExitCode& exit);
void addReport(CLI::App& app, ExitCode& exit);
void addExport(CLI::App& app, ExitCode& exit);
void addFigures(CLI::App& app, ExitCode& exit);
void addStudy(CLI::App& app, ExitCode& exit);
void addLearn(CLI::App& app, ExitCode& exit);
void addCorrect(CLI::App& app, ExitCode& exit);
void addDrift(CLI::App& app, ExitCode& exit);
void addExplore(CLI::App& app, ExitCode& exit);

}  // namespace capstan::cli
