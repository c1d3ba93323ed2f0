// diagnosis_study [--group development] [--seeds 8] [--none 80] [--two 40] [--uncovered 30] [--threads 2]
// [--out DIR] [--shard i/n] …: plants every effect in robots, has each recording diagnosed and says how often
// the answer is right. `--shard i/n` runs one part of the cases into a folder of its own; `--from DIR…`
// collects the cases of all parts in --out and counts them. Cases that DIR holds already are not run again,
// so that an interrupted study goes on where it stopped; --tables only counts what is there. Methods are
// developed on the group `development`, constants are chosen on `choosing`; `blind` has the seeds of the
// program's commit, so that no one has met its cases.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <deque>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/software.h"
#include "core/diagnosis/diagnose.h"
#include "core/experiments/shard.h"
#include "tests/support/planted_study/run_study.h"
#include "tests/support/planted_study/study_tables.h"

namespace {

using namespace capstan;

constexpr std::uint64_t kChoosingSeed = 500'000;

struct Wanted {
  study::StudyOptions cases;
  int threads = 2;
  std::string out = "diagnosis_study", robot = "all", group = "development";
  std::string shard;
  std::vector<std::string> from;
  bool tables = false, rigid = false;
};

/// The program; a build that no commit stands for is told by its bytes.
std::string program() {
  const std::string software = base::software();
  const bool exact = software.find('(') != std::string::npos && software.find("dirty") == std::string::npos;
  return exact ? software : software + " " + base::checksumOfFile("/proc/self/exe");
}

diagnosis::Report diagnosed(const std::vector<diagnosis::Evidence>& recordings,
                            const robot::Description& nominal) {
  diagnosis::DiagnosisOptions options;
  options.threads = 1;
  options.show = false;
  options.filter = false;
  options.material = {0.0, 0.0};  // just visible effects are below every useful tolerance
  return diagnosis::diagnose(recordings, nominal, options);
}

/// First seed of the cases that nobody has met: the program's commit. Throws base::InputError for a build of
/// no commit.
std::uint64_t blindSeed() {
  const std::string software = base::software();
  const std::size_t begin = software.find('(');
  std::uint64_t seed = 0;
  if (begin != std::string::npos && software.find("dirty") == std::string::npos)
    std::from_chars(software.data() + begin + 1, software.data() + software.size(), seed, 16);
  if (seed == 0)
    throw base::InputError({"", 0, "group", "blind",
                            "needs the seeds of a commit, and " + software + " is none",
                            "Commit all changes, configure and build again"});
  return seed;
}

/// Groups other than development have their own seeds. With the first seed of an earlier blind study, the
/// group choosing runs its cases again.
void chooseGroup(Wanted& wanted, bool seed_given) {
  if (wanted.group == "development") return;
  const bool blind = wanted.group == "blind";
  if (blind && seed_given)
    throw base::InputError({"", 0, "first-seed", std::to_string(wanted.cases.first_seed),
                            "cannot be chosen in the group blind", "Remove --first-seed"});
  wanted.cases.population = study::Population::kVaried;
  if (!seed_given) wanted.cases.first_seed = blind ? blindSeed() : kChoosingSeed;
}

void tell(const study::Step& step) {
  const study::CaseOutcome& outcome = step.outcome;
  const study::NamedCause* first = study::firstCause(outcome.answer);
  std::fprintf(stderr, "%zu/%zu %s: %s%s (%.1f s; %.0f min left)\n", step.done, step.of,
               outcome.of.name().c_str(), outcome.answer.verdict.c_str(),
               first ? fmt::format(", {} {}", first->effect, first->joint).c_str() : "",
               outcome.answer.seconds, step.seconds_left / 60.0);
}

/// Cases of the shard "i/n"; empty: all.
std::vector<study::StudyCase> shardOf(const std::vector<study::StudyCase>& cases, const std::string& shard) {
  if (shard.empty()) return cases;
  const experiments::Shard part = experiments::parseShard(shard);
  std::vector<study::StudyCase> own;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (part.owns(k)) own.push_back(cases[k]);
  return own;
}

/// Adds to `file` the outcomes of this program in the files of `folders`. Throws base::InputError when a case
/// is in none of them.
void collect(const std::vector<study::StudyCase>& cases, const std::vector<std::string>& folders,
             study::OutcomeFile& file) {
  std::deque<study::OutcomeFile> parts;
  for (const std::string& folder : folders)
    parts.emplace_back(std::filesystem::path(folder) / "cases.jsonl", program());
  for (const study::StudyCase& one : cases) {
    std::optional<study::CaseOutcome> outcome = file.find(one);
    if (outcome) continue;
    for (const study::OutcomeFile& part : parts)
      if (!outcome) outcome = part.find(one);
    if (!outcome)
      throw base::InputError({{},
                              0,
                              "from",
                              fmt::format("{}", fmt::join(folders, " ")),
                              fmt::format("case {} of {} is in none of them", one.name(), program()),
                              "Run all shards with this program and the same options, and name all folders"});
    file.keep(*outcome);
  }
}

void run(const Wanted& wanted) {
  const std::filesystem::path folder = wanted.out;
  std::vector<study::StudyCase> cases = study::casesOf(wanted.cases);
  if (wanted.rigid)
    std::erase_if(cases, [](const study::StudyCase& one) { return one.robot != study::Robot::kJoints; });
  cases = shardOf(cases, wanted.shard);
  study::OutcomeFile file(folder / "cases.jsonl", program());
  for (const std::string& notice : file.notices()) std::fprintf(stderr, "%s\n", notice.c_str());
  if (!wanted.from.empty())
    collect(cases, wanted.from, file);
  else if (!wanted.tables)
    study::runStudy(cases, diagnosed, wanted.threads, file, tell);
  if (!wanted.shard.empty()) return;
  std::vector<study::CaseOutcome> outcomes;
  for (const study::StudyCase& one : cases)
    if (auto outcome = file.find(one, wanted.tables)) outcomes.push_back(std::move(*outcome));
  const study::Summary summary = study::summaryOf(outcomes);
  study::writeTables(summary, folder);
  std::fputs(study::markdownOf(summary).c_str(), stdout);
}

void addOptions(CLI::App& app, Wanted& wanted) {
  app.add_option("--group", wanted.group, "development, choosing or blind")
      ->check(CLI::IsMember({"development", "choosing", "blind"}));
  app.add_option("--seeds", wanted.cases.seeds, "cases of each effect")->check(CLI::Range(0, 10000));
  app.add_option("--none", wanted.cases.none, "recordings without an effect")->check(CLI::Range(0, 100000));
  app.add_option("--two", wanted.cases.two, "with two effects")->check(CLI::Range(0, 100000));
  app.add_option("--uncovered", wanted.cases.uncovered, "with an effect that no hypothesis covers")
      ->check(CLI::Range(0, 100000));
  app.add_option("--first-seed", wanted.cases.first_seed,
                 "another one: another study; not in the group blind");
  app.add_option("--threads", wanted.threads)->check(CLI::Range(1, 256));
  app.add_option("--out", wanted.out, "folder of cases.jsonl and the tables");
  CLI::Option* shard =
      app.add_option("--shard", wanted.shard, "part i of n of the cases: i/n, for example 2/8");
  app.add_option("--from", wanted.from, "folders of all shards: collects their cases and runs none")
      ->check(CLI::ExistingDirectory)
      ->excludes(shard);
  app.add_option("--only", wanted.cases.only, "effects, or none, two, uncovered");
  app.add_option("--robot", wanted.robot, "raven, arm, axis; all: mixed")
      ->check(CLI::IsMember({"raven", "arm", "axis", "all"}));
  app.add_flag("--rigid", wanted.rigid, "only those cases of the study whose robot is a rigid drive");
  app.add_flag("--tables", wanted.tables,
               "run nothing: tables of the cases that are there, whatever made them");
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("How often the diagnosis of a planted effect is right");
  addOptions(app, wanted);
  CLI11_PARSE(app, argc, argv);
  try {
    if (const auto robot = base::fromName<study::Robot>(wanted.robot)) wanted.cases.robots = {*robot};
    chooseGroup(wanted, app.count("--first-seed") > 0);
    run(wanted);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "diagnosis_study: %s\n", error.what());
    return 1;
  }
}
