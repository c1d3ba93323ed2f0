// next_experiment_study [--ties 20] [--first-seed 1] [--duration 12] [--threads 2]: does the proposed
// experiment resolve ties? Draws robots with one planted effect until a short recording of each of so many
// leaves a tie with that effect. Each robot then makes the proposed motion, and a random motion of the same
// length, and each is diagnosed together with the first recording.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/stats/proportion.h"
#include "tests/support/planted_study/score.h"
#include "tests/support/planted_study/study_cases.h"

namespace {

using namespace capstan;

struct Wanted {
  int ties = 20, most = 2000, threads = 2;
  std::uint64_t first_seed = 1;
  double duration = 12.0;  // of the first recording [s]
};

/// A tie, and the results of diagnosing a second recording with the first one.
struct Resolved {
  study::StudyCase of;
  std::string motion;
  double now = 0.0, after = 0.0;  // stated probability of a wrong choice
  study::Hit proposed = study::Hit::kError, random = study::Hit::kError;
};

diagnosis::Evidence evidenceOf(const test::Recording& recording) {
  return diagnosis::evidenceOf(recording.table, recording.robot);
}

diagnosis::Report diagnosed(const std::vector<diagnosis::Evidence>& recordings,
                            const robot::Description& nominal, bool show) {
  diagnosis::DiagnosisOptions options;
  options.threads = 1;
  options.show = show;
  options.filter = false;
  return diagnosis::diagnose(recordings, nominal, options);
}

study::CaseOutcome outcomeOf(const study::StudyCase& one, const test::Truth& truth,
                             const diagnosis::Report& report) {
  study::CaseOutcome outcome;
  outcome.of = one;
  outcome.truth.items = truth.items;
  outcome.answer = study::answerOf(report, 0.0);
  return outcome;
}

test::JointPath pathOf(const diagnosis::NextExperiment& next) {
  return [&next](double t) {
    test::Joints q{};
    const double step = next.t[1] - next.t[0];
    const double at = std::clamp(t / step, 0.0, static_cast<double>(next.t.size() - 1));
    const auto k = std::min(static_cast<std::size_t>(at), next.t.size() - 2);
    const double share = at - static_cast<double>(k);
    for (std::size_t j = 0; j < next.q.size(); ++j)
      q[j] = (1.0 - share) * next.q[j][k] + share * next.q[j][k + 1];
    return q;
  };
}

/// Empty: the first recording leaves no tie with the planted effect.
std::optional<Resolved> resolved(const study::StudyCase& one, double duration) {
  test::PlantedCase drawn = study::planned(one);
  drawn.duration = duration;
  const auto [first, truth] = test::recordWithTruth(drawn);
  const diagnosis::Evidence evidence = evidenceOf(first);
  const diagnosis::Report before = diagnosed({evidence}, first.robot, true);
  if (!before.next || before.verdict != diagnosis::Verdict::kTie ||
      study::scoreOne(outcomeOf(one, truth, before)).hit != study::Hit::kTie)
    return std::nullopt;
  const diagnosis::NextExperiment& next = *before.next;
  const auto hitWith = [&](const test::JointPath& path) {
    const test::Recording second = test::recordAgain(drawn, path, next.t.back(), one.seed + 1'000'000);
    return study::scoreOne(
               outcomeOf(one, truth, diagnosed({evidence, evidenceOf(second)}, first.robot, false)))
        .hit;
  };
  return Resolved{one,        next.motion, next.confusion_now, next.confusion_after, hitWith(pathOf(next)),
                  hitWith({})};
}

void print(const std::vector<Resolved>& ties) {
  fmt::print(
      "\n| case | proposed motion | wrong choice, stated [%] | after the proposed motion | after a random "
      "motion |\n"
      "|:--|:--|--:|:--|:--|\n");
  std::size_t proposed = 0, random = 0;
  for (const Resolved& one : ties) {
    fmt::print("| {} | {} | {:.1f} → {:.1f} | {} | {} |\n", one.of.name(), one.motion, 100.0 * one.now,
               100.0 * one.after, base::nameOf(one.proposed), base::nameOf(one.random));
    proposed += one.proposed == study::Hit::kRight;
    random += one.random == study::Hit::kRight;
  }
  for (const auto& [name, count] : {std::pair{"proposed", proposed}, std::pair{"random", random}}) {
    const auto interval = stats::clopperPearsonInterval(count, ties.size());
    fmt::print(
        "{} motion: {} of {} resolved, 95 % interval {:.0f} to {:.0f} % (goal of the proposed one: 80 %)\n",
        name, count, ties.size(), 100.0 * interval.low, 100.0 * interval.high);
  }
}

void run(const Wanted& wanted) {
  study::StudyOptions options;
  options.none = options.two = options.uncovered = 0;
  options.seeds = 1 + wanted.most / 20;
  options.first_seed = wanted.first_seed;
  options.robots = {study::Robot::kRaven};
  const std::vector<study::StudyCase> cases = study::casesOf(options);
  std::vector<Resolved> ties;
  for (std::size_t k = 0; k < cases.size() && ties.size() < static_cast<std::size_t>(wanted.ties);) {
    const std::size_t some = std::min(cases.size() - k, static_cast<std::size_t>(2 * wanted.threads));
    std::vector<std::optional<Resolved>> found(some);
    base::parallelFor(some, wanted.threads,
                      [&](std::size_t i) { found[i] = resolved(cases[k + i], wanted.duration); });
    k += some;
    for (auto& one : found)
      if (one) {
        std::fprintf(stderr, "%s: %s; random: %s\n", one->of.name().c_str(),
                     std::string(base::nameOf(one->proposed)).c_str(),
                     std::string(base::nameOf(one->random)).c_str());
        ties.push_back(std::move(*one));
      }
    std::fprintf(stderr, "%zu recordings, %zu ties\n", k, ties.size());
  }
  if (ties.size() > static_cast<std::size_t>(wanted.ties)) ties.resize(static_cast<std::size_t>(wanted.ties));
  print(ties);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Does the proposed experiment resolve ties?");
  Wanted wanted;
  app.add_option("--ties", wanted.ties)->check(CLI::Range(1, 1000));
  app.add_option("--first-seed", wanted.first_seed);
  app.add_option("--duration", wanted.duration, "of the first recording [s]")->check(CLI::Range(5.0, 60.0));
  app.add_option("--threads", wanted.threads)->check(CLI::Range(1, 64));
  CLI11_PARSE(app, argc, argv);
  try {
    run(wanted);
    return 0;
  } catch (const base::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
