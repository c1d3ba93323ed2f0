#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/progress.h"

namespace capstan::cli {

/// What every study's command is asked beside its own options.
struct StudyArguments {
  std::string out;    ///< --out: a folder for the tables, and for finished trials; empty: none
  std::string json;   ///< --json
  bool keeps = true;  ///< finished trials are kept in `out`, so that a study goes on where it was stopped
};

/// Declares --threads, --out and --json. `trials`: noun of what runs in parallel and is stored, as "samples".
void addStudyOptions(CLI::App& command, StudyArguments& arguments, int& threads, const std::string& trials);

/// A study's results as people and programs read them.
struct StudyReport {
  std::string text;  ///< Markdown
  nlohmann::json json;
  /// What goes into --out besides the text: names of files and what is in them.
  std::vector<std::pair<std::string, std::string>> files;
};

/// Before anything is computed: outputs that can be written and are none of `inputs`. Throws
/// base::InputError.
void checkStudyOutputs(const StudyArguments& arguments, const std::string& name,
                       const std::vector<OutputFile>& more, const std::vector<std::string>& inputs);
/// Standard output, --json and --out: NAME.md and the report's files.
void writeStudy(const StudyArguments& arguments, const std::string& name, const StudyReport& report);

/// A study from its options to its outputs: `run(progress)` makes it, with a line of progress, Ctrl-C cancels
/// it, `report(study)` says what it found. A study has `cancelled` and `notices`. Where it was cancelled,
/// `done(study)` says whether what there is deserves a report all the same; the exit code is kFailed then.
template <class Run, class Done, class Report>
ExitCode runStudy(const StudyArguments& arguments, const std::string& name, Run&& run, Done&& done,
                  Report&& report) {
  base::Progress progress;
  const auto study = [&] {
    const ProgressLine line(progress);
    return run(progress);
  }();
  for (const std::string& text : study.notices) notice(text);
  if (study.cancelled)
    notice(arguments.out.empty() || !arguments.keeps ? "cancelled"
                                                     : "cancelled: the same command goes on from here");
  if (study.cancelled && !done(study)) return kFailed;
  writeStudy(arguments, name, report(study));
  return study.cancelled ? kFailed : kOk;
}

}  // namespace capstan::cli
