// filter_gain_study [--effects backlash …] [--size 0.7] [--seed 1] [--duration 40] …: plants an
// effect in the RAVEN-II, has the first half of the recording diagnosed and runs the Kalman filter over the
// second half with the nominal robot, with its refitted numbers and with the extended robot: RMS of the
// joints against the encoders. Once with the filter's own process noise, which stands for what a nominal
// model does not know, once with a share of it (--process-noise 0.1). All in the kernel that effects need;
// "as tracked" is the nominal robot in the kernel that it has in tracking.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <stdexcept>

#include "core/base/resource.h"
#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/filter_gain.h"
#include "core/diagnosis/report/shown.h"
#include "tests/support/planted/planted_case.h"

namespace {

using namespace capstan;

struct Wanted {
  std::vector<std::string> effects = {"pulley_radius", "homing_offset", "capstan_eccentricity", "backlash",
                                      "stribeck_friction"};
  double size = 0.7, duration = 40.0, process_noise = 0.1;
  std::uint64_t seed = 1;
  int joint = -1, threads = 2;
};

recording::MeasuredTable rowsOf(const recording::MeasuredTable& whole, std::size_t begin, std::size_t end) {
  recording::MeasuredTable part = whole;
  const auto cut = [&](std::vector<double>& column) {
    column = std::vector<double>(column.begin() + static_cast<std::ptrdiff_t>(begin),
                                 column.begin() + static_cast<std::ptrdiff_t>(end));
  };
  cut(part.t);
  for (recording::TableColumns* columns :
       {&part.q_m, &part.dq_m, &part.tau_m, &part.q, &part.p_c, &part.tau_ext})
    for (std::vector<double>& column : *columns) cut(column);
  return part;
}

test::PlantedCase caseOf(const Wanted& wanted, const std::string& effect, std::uint64_t seed) {
  const test::EffectFacts* facts = test::effectNamed(effect);
  if (!facts) throw std::invalid_argument("no effect " + effect + ", planted --list names them");
  test::DrawOptions options;
  options.robot = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  options.effect = facts->effect;
  options.size = wanted.size;
  options.duration = wanted.duration;
  if (wanted.joint >= 0) options.joint = wanted.joint;
  return test::draw(seed, options);
}

std::string namedIn(const diagnosis::Report& report) {
  std::string named = std::string(base::nameOf(report.verdict));
  for (const diagnosis::Cause& cause : report.causes)
    named += fmt::format(" {} {}", cause.effect, cause.joint);
  for (const diagnosis::Tie& tie : report.ties)  // the first of them is among the causes
    for (std::size_t k = 1; k < tie.causes.size(); ++k)
      named += fmt::format(" or {} {}", tie.causes[k].effect, tie.causes[k].joint);
  return named;
}

std::string cells(const diagnosis::FilterGain& one) {
  const double scale = diagnosis::shownUnit(one.unit).scale;
  return fmt::format("{:.4f} | {:.4f} | {:.4f} | {:+.0f} %", scale * one.nominal, scale * one.refitted,
                     scale * one.extended, 100.0 * (one.extended / one.nominal - 1.0));
}

void study(const Wanted& wanted, const std::string& effect, std::uint64_t seed) {
  const test::PlantedCase planted = caseOf(wanted, effect, seed);
  const test::Recording recording = test::record(planted);
  const std::size_t rows = recording.table.rows();
  const diagnosis::Evidence fitted =
      diagnosis::evidenceOf(rowsOf(recording.table, 0, rows / 2), recording.robot);
  const diagnosis::Evidence held_out =
      diagnosis::evidenceOf(rowsOf(recording.table, rows / 2, rows), recording.robot);
  diagnosis::DiagnosisOptions options;
  options.threads = wanted.threads;
  options.show = false;
  const diagnosis::Report report = diagnosis::diagnose({fitted}, recording.robot, options);
  const diagnosis::FilterRobots robots = {recording.robot, report.refitted, report.extended};
  diagnosis::FilterGainOptions own, sure, as_tracked;
  own.threads = sure.threads = as_tracked.threads = wanted.threads;
  sure.tracking.position_noise *= wanted.process_noise;
  sure.tracking.velocity_noise *= wanted.process_noise;
  as_tracked.one_kernel = false;
  const diagnosis::FilterGainReport gain = diagnosis::filterGain({held_out}, robots, own),
                                    gain_sure = diagnosis::filterGain({held_out}, robots, sure),
                                    nominal = diagnosis::filterGain({held_out}, robots, as_tracked);
  for (std::size_t j = 0; j < gain.joints.size(); ++j)
    std::puts(fmt::format("| {} {}{} | {} | {} [{}] | {:.4f} | {} | {} |", effect,
                          planted.effects.front().joint, planted.textured ? ", textured" : "",
                          namedIn(report), gain.joints[j].joint,
                          diagnosis::shownUnit(gain.joints[j].unit).unit,
                          diagnosis::shownUnit(gain.joints[j].unit).scale * nominal.joints[j].nominal,
                          cells(gain.joints[j]), cells(gain_sure.joints[j]))
                  .c_str());
  for (const std::string& notice : gain.notices) std::fprintf(stderr, "%s\n", notice.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("What the Kalman filter gains from the diagnosis of planted effects");
  app.add_option("--effects", wanted.effects, "their names");
  app.add_option("--joint", wanted.joint, "from 1; unset: drawn");
  app.add_option("--size", wanted.size, "0.1 just visible, 1 large")->check(CLI::Range(0.01, 10.0));
  app.add_option("--duration", wanted.duration, "s, both halves")->check(CLI::Range(10.0, 600.0));
  app.add_option("--process-noise", wanted.process_noise, "of the second run, as a share of the filter's own")
      ->check(CLI::Range(1e-3, 1e3));
  app.add_option("--seed", wanted.seed, "of the first effect's robot; the next has the next");
  app.add_option("--threads", wanted.threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  try {
    std::puts(fmt::format("| planted | verdict | RMS of | as tracked | nominal | refitted | extended | "
                          "change | process noise "
                          "x {}: nominal | refitted | extended | change |",
                          wanted.process_noise)
                  .c_str());
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (std::size_t k = 0; k < wanted.effects.size(); ++k) study(wanted, wanted.effects[k], wanted.seed + k);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "filter_gain_study: %s\n", error.what());
    return 1;
  }
}
