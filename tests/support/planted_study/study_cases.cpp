#include "tests/support/planted_study/study_cases.h"
#include "tests/support/folders.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "tests/support/planted_study/varied_case.h"

namespace capstan::study {
namespace {

constexpr std::array kUncoveredTurns = {test::Effect::kExternalVibration, test::Effect::kNonlinearSpring,
                                        test::Effect::kJointDetent,       test::Effect::kNonlinearSpring,
                                        test::Effect::kExternalVibration, test::Effect::kEncoderDrift};

/// Streams of seeds of what is no single effect; effects have those of their place in the list.
constexpr int kNoneStream = 900, kTwoStream = 901, kUncoveredStream = 902;

std::uint64_t seedOf(const StudyOptions& options, int turn, int stream) {
  return (options.first_seed + static_cast<std::uint64_t>(turn)) * 1000 + static_cast<std::uint64_t>(stream);
}

test::DrawOptions drawOptions(Robot which) {
  test::DrawOptions options;
  options.robot = robotOf(which);
  options.rigid = which != Robot::kRaven;
  return options;
}

bool makesSense(test::Effect effect, Robot which) {
  static const std::array options = {drawOptions(Robot::kRaven), drawOptions(Robot::kArm),
                                     drawOptions(Robot::kAxis)};
  // A camera that follows a point on a line cannot tell a rotation about it.
  if (which == Robot::kAxis && test::factsOf(effect).place == test::Place::kCamera) return false;
  return !test::jointsFor(effect, options[static_cast<std::size_t>(which)]).empty();
}

/// The robot of the turn'th case of an effect; nothing: it makes no sense on those that are wanted.
std::optional<Robot> robotFor(test::Effect effect, int turn, const StudyOptions& options) {
  const int at = turn + static_cast<int>(effect);
  std::vector<Robot> wanted = options.robots;
  if (wanted.empty()) {
    const bool both = makesSense(effect, Robot::kRaven) && makesSense(effect, Robot::kArm);
    const bool rigid = both ? at % 4 == 3 : !makesSense(effect, Robot::kRaven);
    const bool axis = (both ? at / 4 : at) % 2 != 0;
    wanted = {rigid ? (axis ? Robot::kAxis : Robot::kArm) : Robot::kRaven};
    if (axis && rigid) wanted.push_back(Robot::kArm);
  } else {
    std::rotate(wanted.begin(), wanted.begin() + at % static_cast<int>(wanted.size()), wanted.end());
  }
  for (const Robot which : wanted)
    if (makesSense(effect, which)) return which;
  return std::nullopt;
}

Robot robotFor(int turn, const StudyOptions& options) {
  const std::array usual = {Robot::kRaven, Robot::kRaven, Robot::kRaven,
                            turn % 8 < 4 ? Robot::kArm : Robot::kAxis};
  const auto at = static_cast<std::size_t>(turn);
  return options.robots.empty() ? usual[at % 4] : options.robots[at % options.robots.size()];
}

bool isWanted(const StudyOptions& options, std::string_view name) {
  return options.only.empty() ||
         std::find(options.only.begin(), options.only.end(), name) != options.only.end();
}

void checkNames(const StudyOptions& options) {
  for (const std::string& name : options.only)
    if (name != "none" && name != "two" && name != "uncovered" && !test::effectNamed(name))
      throw base::InputError({"", 0, "only", name, "is no effect that can be planted",
                              "Name one of those that `planted --list` prints, or none, two, uncovered."});
}

void addTurn(const StudyOptions& options, int turn, std::vector<StudyCase>& cases) {
  if (turn < options.seeds)
    for (const test::EffectFacts& facts : test::allEffects())
      if (facts.covered && isWanted(options, facts.name))
        if (const auto which = robotFor(facts.effect, turn, options))
          cases.push_back({Kind::kOne, *which, std::string(facts.name),
                           seedOf(options, turn, static_cast<int>(facts.effect))});
  const auto share = [&](int count, int part) {  // of `count` as many in each turn
    return std::pair(count * part / std::max(options.seeds, 1),
                     count * (part + 1) / std::max(options.seeds, 1));
  };
  if (isWanted(options, "none"))
    for (auto [i, end] = share(options.none, turn); i < end; ++i)
      cases.push_back({Kind::kNone, robotFor(i, options), "", seedOf(options, i, kNoneStream)});
  if (isWanted(options, "two"))
    for (auto [i, end] = share(options.two, turn); i < end; ++i)
      cases.push_back({Kind::kTwo, robotFor(i, options), "", seedOf(options, i, kTwoStream)});
  for (auto [i, end] = share(options.uncovered, turn); i < end; ++i) {
    const test::Effect effect = kUncoveredTurns[static_cast<std::size_t>(i) % kUncoveredTurns.size()];
    const std::string name(test::factsOf(effect).name);
    if (!isWanted(options, "uncovered") && !isWanted(options, name)) continue;
    if (const auto which = robotFor(effect, i + i / 6, options))
      cases.push_back({Kind::kUncovered, *which, name, seedOf(options, i, kUncoveredStream)});
  }
}

/// Two of three varied cases, and all that would have the axis, have a random robot.
void vary(StudyCase& one) {
  one.population = Population::kVaried;
  if (one.seed / 1000 % 3 == 0 && one.robot != Robot::kAxis) return;
  one.robot = one.robot == Robot::kRaven ? Robot::kCables : Robot::kJoints;
}

}  // namespace

std::string StudyCase::name() const {
  return fmt::format("{} {} {} {}{}", base::nameOf(kind), effect.empty() ? "-" : effect, base::nameOf(robot),
                     seed, population == Population::kVaried ? " varied" : "");
}

StudyCase caseNamed(const std::string& name) {
  std::istringstream words(name);
  std::string kind, effect, robot, population;
  StudyCase one;
  words >> kind >> effect >> robot >> one.seed;
  const bool whole = !words.fail();
  words >> population;
  const auto of_kind = base::fromName<Kind>(kind);
  const auto which = base::fromName<Robot>(robot);
  if (!whole || !of_kind || !which || (effect != "-" && !test::effectNamed(effect)) ||
      (!population.empty() && population != "varied"))
    throw std::invalid_argument("no case is named " + name + ", as in \"one backlash raven 1008\"");
  one.kind = *of_kind;
  one.robot = *which;
  if (effect != "-") one.effect = effect;
  if (!population.empty()) one.population = Population::kVaried;
  return one;
}

std::vector<StudyCase> casesOf(const StudyOptions& options) {
  checkNames(options);
  std::vector<StudyCase> cases;
  for (int turn = 0; turn < std::max(options.seeds, 1); ++turn) addTurn(options, turn, cases);
  if (options.population == Population::kVaried)
    for (StudyCase& one : cases) vary(one);
  if (cases.empty())
    throw base::InputError({"", 0, "only", fmt::format("{}", fmt::join(options.only, " ")),
                            "leaves no case on these robots", "Ask for more cases, effects or robots."});
  return cases;
}

test::PlantedCase planned(const StudyCase& one, std::optional<double> size) {
  test::DrawOptions options =
      one.population == Population::kVaried ? variedOptions(one) : drawOptions(one.robot);
  options.effects = one.kind == Kind::kNone ? 0 : one.kind == Kind::kTwo ? 2 : 1;
  options.size = size;
  if (!one.effect.empty()) options.effect = test::effectNamed(one.effect)->effect;
  return test::draw(one.seed, options);
}

robot::Description robotOf(Robot which) {
  if (which == Robot::kRaven) return robot::readDescription(base::resource("robots/raven2_left.yaml"));
  return robot::readDescription(test::sourceFile(which == Robot::kArm
                                                     ? "tests/support/planted/data/rigid_arm.yaml"
                                                     : "tests/support/planted/data/rigid_axis.yaml"));
}

}  // namespace capstan::study
