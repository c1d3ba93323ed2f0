// planted --effect backlash --joint 2 --size 0.5 --seed 7 --out rec.csv: a recording of a robot with a
// planted fault as a measured table; --truth writes what was planted. What is not requested is drawn from the
// seed. planted --case "one backlash cables 500000008 varied" --nominal robot.yaml --out rec.csv: a case of
// diagnosis_study with its robot file; --worn writes the robot after wear.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "tests/support/planted_study/run_case.h"

namespace {

using namespace capstan;

struct Wanted {
  std::uint64_t seed = 1;
  std::string effect, out, truth, robot, study_case, nominal, worn;
  int joint = -1, effects = 1;
  double size = -1.0, duration = 0.0;
  bool rigid = false, textured = false, plain = false, no_cameras = false, no_encoders = false, list = false;
};

test::DrawOptions optionsOf(const Wanted& wanted) {
  test::DrawOptions options;
  options.robot = robot::readDescription(wanted.robot.empty() ? base::resource("robots/raven2_left.yaml")
                                                              : std::filesystem::path(wanted.robot));
  options.rigid = wanted.rigid;
  options.effects = wanted.effects;
  options.sensors.cameras = !wanted.no_cameras;
  options.sensors.joint_encoders = !wanted.no_encoders;
  if (wanted.effect == "none") options.effects = 0;
  if (!wanted.effect.empty() && wanted.effect != "none") {
    const test::EffectFacts* facts = test::effectNamed(wanted.effect);
    if (!facts) throw std::invalid_argument("no effect " + wanted.effect + ", --list names them");
    options.effect = facts->effect;
  }
  if (wanted.joint >= 0) options.joint = wanted.joint;
  if (wanted.size >= 0.0) options.size = wanted.size;
  if (wanted.duration > 0.0) options.duration = wanted.duration;
  if (wanted.textured || wanted.plain) options.textured = wanted.textured;
  return options;
}

nlohmann::json jsonOf(const test::Truth& truth, std::uint64_t seed) {
  nlohmann::json json{{"seed", seed}, {"textured", truth.textured}, {"effects", nlohmann::json::array()}};
  for (const auto& item : truth.items)
    json["effects"].push_back(
        {{"effect", item.effect},
         {"joint", item.joint},
         {"size", item.size},
         {"visibility", item.visibility},
         {"magnitude", item.planted.magnitude},
         {"unit", test::factsOf(item.planted.effect).magnitude},
         {"signature", item.planted.signature},
         {"phase", item.planted.phase},
         {"other", item.planted.other + 1},
         {"axis", {item.planted.axis.x(), item.planted.axis.y(), item.planted.axis.z()}}});
  return json;
}

study::RecordedCase recorded(const Wanted& wanted) {
  if (!wanted.study_case.empty()) return study::recordCase(study::caseNamed(wanted.study_case));
  const test::PlantedCase drawn = test::draw(wanted.seed, optionsOf(wanted));
  auto [recording, truth] = test::recordWithTruth(drawn);
  return {drawn, std::move(recording), std::move(truth)};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path);
}

}  // namespace

int main(int argc, char** argv) {
  Wanted wanted;
  CLI::App app("Recordings of a robot with a planted fault");
  app.add_option("--effect", wanted.effect, "name of the effect, or none; unset: drawn");
  app.add_option("--joint", wanted.joint, "from 1; 0: the whole arm or a camera");
  app.add_option("--size", wanted.size,
                 "0 none, 0.1 just visible, 1 large, above: up to the largest plausible")
      ->check(CLI::Range(0.0, 1e4));
  app.add_option("--seed", wanted.seed);
  app.add_option("--effects", wanted.effects, "how many")->check(CLI::Range(0, 2));
  app.add_option("--duration", wanted.duration, "s")->check(CLI::Range(1.0, 3600.0));
  app.add_option("--robot", wanted.robot, "robot file; unset: RAVEN-II")->check(CLI::ExistingFile);
  app.add_option("--case", wanted.study_case,
                 "name of a case of diagnosis_study; replaces all other options of it");
  app.add_option("--nominal", wanted.nominal, "robot file to write, before wear and effects");
  app.add_option("--worn", wanted.worn, "robot file to write, after wear, without effects");
  app.add_option("--out", wanted.out, "CSV file to write");
  app.add_option("--truth", wanted.truth, "JSON file of what was planted; unset: standard output");
  app.add_flag("--rigid", wanted.rigid, "motor torque drives the joints, no cables");
  app.add_flag("--textured", wanted.textured, "with background texture; neither this nor --plain: drawn");
  app.add_flag("--plain", wanted.plain, "without background texture");
  app.add_flag("--no-cameras", wanted.no_cameras);
  app.add_flag("--no-encoders", wanted.no_encoders);
  app.add_flag("--list", wanted.list, "names of the effects");
  CLI11_PARSE(app, argc, argv);
  try {
    if (wanted.list)
      for (const auto& facts : test::allEffects())
        std::printf("%.*s\n", static_cast<int>(facts.name.size()), facts.name.data());
    if (wanted.list) return 0;
    const auto begin = std::chrono::steady_clock::now();
    const auto [drawn, recording, truth] = recorded(wanted);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    if (!wanted.out.empty()) write(wanted.out, recording::formatMeasuredTable(recording.table));
    if (!wanted.nominal.empty()) write(wanted.nominal, robot::formatDescription(recording.robot));
    if (!wanted.worn.empty()) write(wanted.worn, robot::formatDescription(truth.robot));
    nlohmann::json json = jsonOf(truth, drawn.seed);
    const std::string text = json.dump() + "\n";
    if (wanted.truth.empty())
      std::fputs(text.c_str(), stdout);
    else
      write(wanted.truth, text);
    std::fprintf(stderr, "%.0f s recorded in %.2f s\n", drawn.duration, took.count());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "planted: %s\n", error.what());
    return 1;
  }
}
