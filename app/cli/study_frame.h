#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/shard_option.h"
#include "core/base/progress.h"

namespace capstan::cli {

/// Arguments that all studies have in common.
struct StudyArguments {
  std::string out;    ///< --out: folder for tables and finished trials; empty: none
  std::string json;   ///< --json: file, or - for standard output; empty: none
  bool keeps = true;  ///< finished trials are stored in `out`, so that a stopped study can continue
  ShardArguments shard = {};
};

/// Declares --threads, --out, --json and, where trials are stored, --shard. `trials`: noun in the help for
/// the parallel trials, e.g. "samples".
void addStudyOptions(CLI::App& command, StudyArguments& arguments, int& threads, const std::string& trials);

/// Results of a study for people and programs.
struct StudyReport {
  std::string text;  ///< Markdown
  nlohmann::json json;
  /// Further files of --out: names and contents.
  std::vector<std::pair<std::string, std::string>> files;
};

/// Checks, before anything is computed, that outputs can be written and are none of `inputs`. Throws
/// base::InputError.
void checkStudyOutputs(const StudyArguments& arguments, const std::string& name,
                       const std::vector<OutputFile>& more, const std::vector<std::string>& inputs);
/// Writes the report to standard output, --json and --out (NAME.md and the report's files).
void writeStudy(const StudyArguments& arguments, const std::string& name, const StudyReport& report);

/// Runs a study and writes its report. `run(progress, part)` returns the study, which has `cancelled` and
/// `notices`; `part` are the trials to run, null: all. It shows a line of progress, and Ctrl-C cancels it.
/// `report(study)` returns its StudyReport. For a cancelled study, `done(study)` returns whether its results
/// are reported all the same; the exit code is then kFailed. A shard has no report. `others`: outputs besides
/// --out and --json (option, path).
template <class Run, class Done, class Report>
ExitCode runStudy(const StudyArguments& arguments, const std::string& name, Run&& run, Done&& done,
                  Report&& report, std::vector<std::pair<std::string, std::string>> others = {}) {
  others.emplace_back("--json", arguments.json);
  ShardRun shard(arguments.shard, arguments.out, others);
  base::Progress progress;
  const auto study = [&] {
    const ProgressLine line(progress);
    return run(progress, shard.part());
  }();
  for (const std::string& text : study.notices) notice(text);
  if (study.cancelled)
    notice(arguments.out.empty() || !arguments.keeps ? "cancelled"
                                                     : "cancelled: the same command goes on from here");
  if (study.cancelled && (shard.isShard() || !done(study))) return kFailed;
  if (shard.isShard()) {
    Output({}).text(shard.finish());
    return kOk;
  }
  writeStudy(arguments, name, report(study));
  return study.cancelled ? kFailed : kOk;
}

}  // namespace capstan::cli
