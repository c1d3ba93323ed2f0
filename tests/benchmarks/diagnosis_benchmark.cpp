// How long a diagnosis takes, where the time goes, and how it grows with length, joints and hypotheses: on 1
// kHz recordings of a planted robot with one effect (homing offset), all in one run, on two threads.
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "core/base/resource.h"
#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "tests/support/planted/planted_case.h"

namespace {

using namespace capstan;

/// The first joints of a robot.
robot::Description shortened(robot::Description robot, int joints) {
  const auto n = static_cast<std::size_t>(joints);
  robot.joints.resize(n);
  robot.drives.resize(n);
  robot.coupling.resize(n);
  for (auto& row : robot.coupling) row.resize(n);
  robot.wrist.clear();
  return robot;
}

diagnosis::Evidence recorded(const robot::Description& robot, double duration) {
  test::DrawOptions options;
  options.robot = robot;
  options.effect = test::Effect::kHomingOffset;
  options.joint = robot.size() > 1 ? 2 : 1;
  options.size = 0.5;
  options.textured = true;
  options.duration = duration;
  return diagnosis::evidenceOf(test::record(test::draw(7, options)).table, robot);
}

struct Timed {
  double seconds = 0.0;
  diagnosis::Report report;
};

Timed timed(const diagnosis::Evidence& evidence, const robot::Description& robot,
            const std::vector<std::string>& only) {
  diagnosis::DiagnosisOptions options;
  options.threads = 2;
  options.filter = false;
  options.only = only;
  const auto begin = std::chrono::steady_clock::now();
  Timed result;
  result.report = diagnosis::diagnose({evidence}, robot, options);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

void print(const std::string& what, const Timed& result, double reference) {
  std::string named;
  for (const auto& cause : result.report.causes) named += fmt::format(" {} {}", cause.effect, cause.joint);
  fmt::print("{:34} {:9.2f} {:9.2f} x   {}\n", what, result.seconds, result.seconds / reference,
             named.empty() ? " nothing" : named);
}

std::vector<std::string> firstNames(std::size_t count) {
  std::vector<std::string> names;
  for (const auto& facts : robot::effectFacts())
    if (facts.cable && names.size() < count) names.emplace_back(facts.name);
  return names;
}

}  // namespace

int main() {
  const robot::Description raven = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  fmt::print(
      "diagnosis on 2 of {} threads; 1 kHz, encoders and cameras, textured robot, homing offset hidden\n\n",
      std::thread::hardware_concurrency());
  fmt::print("{:34} {:>9} {:>11}   {}\n", "", "seconds", "of 60 s", "named");
  const Timed whole = timed(recorded(raven, 60.0), raven, {});
  print("60 s, 3 joints, whole library", whole, whole.seconds);
  for (const double duration : {15.0, 30.0})
    print(fmt::format("{:.0f} s", duration), timed(recorded(raven, duration), raven, {}), whole.seconds);
  for (const int joints : {1, 2}) {
    const robot::Description robot = shortened(raven, joints);
    print(fmt::format("60 s, {} joint{}", joints, joints > 1 ? "s" : ""),
          timed(recorded(robot, 60.0), robot, {}), whole.seconds);
  }
  for (const std::size_t count : {6, 13})
    print(fmt::format("60 s, {} hypotheses", count), timed(recorded(raven, 60.0), raven, firstNames(count)),
          whole.seconds);
  fmt::print("\ngoal: 60 s, 3 joints, whole library in 30 s on two cores. Where its time goes:\n");
  for (const auto& stage : whole.report.stages)
    fmt::print("  {:32} {:9.2f} s {:5.0f} %\n", stage.name, stage.seconds,
               100.0 * stage.seconds / whole.seconds);
}
