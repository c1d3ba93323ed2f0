// Which cases a study has, how it runs them with something in the place of a diagnosis, and how it goes on
// after an interruption.
#include <atomic>
#include <fstream>
#include <set>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "tests/support/planted_study/run_study.h"
#include "tests/support/planted_study/study_tables.h"
#include "tests/support_tests/planted_robots.h"
#include "tests/support_tests/study_outcomes.h"

namespace capstan::study {
namespace {

TEST(StudyCases, EveryEffectAndAllTheRest) {
  const std::vector<StudyCase> cases = casesOf({});
  std::map<Kind, int> kinds;
  std::map<std::string, int> effects, rigid;
  std::set<std::string> names;
  std::set<std::uint64_t> seeds;
  for (const StudyCase& one : cases) {
    ++kinds[one.kind];
    ++effects[one.effect];
    rigid[one.effect] += one.robot != Robot::kRaven;
    EXPECT_TRUE(names.insert(one.name()).second) << one.name();
    EXPECT_TRUE(seeds.insert(one.seed).second) << one.name();
  }
  EXPECT_EQ(kinds, (std::map<Kind, int>{
                       {Kind::kOne, 216}, {Kind::kNone, 80}, {Kind::kTwo, 40}, {Kind::kUncovered, 30}}));
  for (const test::EffectFacts& facts : test::allEffects()) {
    const std::string name(facts.name);
    if (!facts.covered) continue;
    EXPECT_EQ(effects[name], 8) << name;
    EXPECT_EQ(rigid[name], !facts.rigid ? 0 : facts.cable ? 2 : 8) << name;
  }
  EXPECT_EQ(effects["external_vibration"], 10);
  EXPECT_EQ(effects["nonlinear_spring"], 10);
  EXPECT_EQ(effects["joint_detent"], 5);
  EXPECT_EQ(effects["encoder_drift"], 5);
}

TEST(StudyCases, AllCanBeDrawnAndHoldWhatTheirNamesSay) {
  for (const StudyCase& one : casesOf({})) {
    const test::PlantedCase drawn = planned(one);
    EXPECT_EQ(drawn.rigid, one.robot != Robot::kRaven);
    EXPECT_EQ(drawn.effects.size(), one.kind == Kind::kNone ? 0U : one.kind == Kind::kTwo ? 2U : 1U);
    EXPECT_GE(drawn.duration, 20.0);
    EXPECT_LE(drawn.duration, 40.0);
    for (const auto& chosen : drawn.effects)
      EXPECT_TRUE(one.effect.empty() || test::factsOf(chosen.effect).name == one.effect);
  }
}

StudyOptions variedOptions() {
  StudyOptions options;
  options.population = Population::kVaried;
  options.first_seed = 1001;
  options.seeds = 2, options.none = 10, options.two = 10, options.uncovered = 10;
  return options;
}

TEST(StudyCases, VariedOnesDifferInMoreThanTheirSeed) {
  std::set<int> joints, styles, periods;
  std::set<double> rates;
  int without_cameras = 0, without_encoders = 0;
  for (const StudyCase& one : casesOf(variedOptions())) {
    const test::PlantedCase drawn = planned(one);
    EXPECT_EQ(one.population, Population::kVaried);
    joints.insert(drawn.robot.size());
    styles.insert(static_cast<int>(drawn.style));
    periods.insert(drawn.sensors.row_period);
    rates.insert(drawn.sensors.frame_rate);
    without_cameras += !drawn.sensors.cameras;
    without_encoders += !drawn.sensors.joint_encoders;
    for (const auto& chosen : drawn.effects)
      EXPECT_TRUE(one.effect.empty() || test::factsOf(chosen.effect).name == one.effect);
    EXPECT_EQ(planned(caseNamed(one.name())).robot.joints[0].link.mass, drawn.robot.joints[0].link.mass);
    EXPECT_EQ(caseNamed(one.name()).name(), one.name());
  }
  EXPECT_THROW(caseNamed("one backlash"), std::invalid_argument);
  EXPECT_THROW(caseNamed("one bachlash raven 1"), std::invalid_argument);
  EXPECT_THROW(planned(caseNamed("one backlash arm 1 varied")), std::invalid_argument);  // has no cable
  EXPECT_EQ(joints, (std::set{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(styles.size(), 4U);
  EXPECT_EQ(periods, (std::set{1, 2, 4}));
  EXPECT_EQ(rates.size(), 5U);
  EXPECT_GT(without_cameras, 0);
  EXPECT_GT(without_encoders, 0);
}

/// The first robot drawn for the hysteresis does not show it, and another one is drawn; the payload is
/// visible on the first.
TEST(StudyCases, VariedOnesShowTheirEffects) {
  for (const auto& [name, again] : {std::pair("one cable_hysteresis cables 1001010 varied", true),
                                    {"one payload cables 1001018 varied", false}}) {
    const StudyCase one = caseNamed(name);
    const RecordedCase shown = recordCase(one);
    EXPECT_EQ(shown.drawn.seed != one.seed, again) << name;
    EXPECT_GE(shown.truth.items.front().visibility, kJustVisible) << name;
  }
}

/// The controller of a plant that is unstable, or has too little torque, does not hold it near the way.
TEST(StudyCases, VariedRobotsFollowEveryStyleWithinTheirLimits) {
  for (StudyCase one : casesOf(variedOptions())) {
    if (one.kind != Kind::kNone) continue;
    test::PlantedCase drawn = planned(one);
    drawn.duration = 4.0;
    drawn.sensors.row_period = 2;
    drawn.sensors.joint_encoders = true;
    const recording::MeasuredTable table = test::record(drawn).table;
    ASSERT_EQ(table.rows(), 2001U);
    base::Random way(drawn.seed, "excitation");
    const test::Excitation desired(drawn.robot, drawn.duration, way, drawn.style);
    for (std::size_t i = 0; i < table.q.size(); ++i) {
      const robot::Joint& joint = drawn.robot.joints[i];
      const double range = joint.limit_high - joint.limit_low;
      for (std::size_t k = 0; k < table.rows(); ++k) {
        const double wanted = desired.at(table.t[k])[i];
        ASSERT_GE(wanted, joint.limit_low) << one.name();
        ASSERT_LE(wanted, joint.limit_high) << one.name();
        ASSERT_NEAR(table.q[i][k], wanted, 0.15 * range) << one.name() << " joint " << i + 1;
      }
    }
  }
}

TEST(StudyCases, ALongerStudyHoldsTheShorterOne) {
  StudyOptions small;
  small.seeds = 2, small.none = 10, small.two = 6, small.uncovered = 6;
  std::set<std::string> large;
  for (const StudyCase& one : casesOf({})) large.insert(one.name());
  for (const StudyCase& one : casesOf(small)) EXPECT_TRUE(large.contains(one.name())) << one.name();
}

TEST(StudyCases, OnlyWhatIsAskedFor) {
  StudyOptions options;
  options.only = {"backlash", "none"};
  options.robots = {Robot::kRaven};
  EXPECT_EQ(casesOf(options).size(), 88U);
  options.only = {"bachlash"};
  try {
    casesOf(options);
    FAIL() << "an unknown effect was taken";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().value, "bachlash");
    EXPECT_FALSE(error.fault().remedy.empty());
  }
  options.only = {"backlash"};
  options.robots = {Robot::kArm};  // has no cables
  EXPECT_THROW(casesOf(options), base::InputError);
}

/// A few cases of the level axis, which are the quickest to record.
std::vector<StudyCase> someCases() {
  StudyOptions options;
  options.seeds = 2, options.none = 2, options.two = 0, options.uncovered = 0;
  options.only = {"inertia", "none"};
  options.robots = {Robot::kAxis};
  return casesOf(options);
}

/// Says "inertia 1" of all, and counts how often it is asked.
struct FakeDiagnosis {
  std::atomic<int> asked{0};
  std::atomic<int> fails_after{1000};

  Diagnoser diagnoser() {
    return [this](const std::vector<diagnosis::Evidence>& evidence, const robot::Description& nominal) {
      EXPECT_EQ(evidence.size(), 1U);
      EXPECT_EQ(evidence[0].drive, diagnosis::DriveKind::kRigid);
      EXPECT_EQ(evidence[0].joints, nominal.size());
      EXPECT_TRUE(evidence[0].title.find("inertia") == std::string::npos) << "the name gives it away";
      EXPECT_EQ(robot::formatDescription(nominal), robot::formatDescription(robotOf(Robot::kAxis)));
      if (++asked > fails_after) throw std::runtime_error("no answer");
      diagnosis::Report report;
      report.verdict = diagnosis::Verdict::kFound;
      diagnosis::Cause named;
      named.effect = "inertia";
      named.joint = 1;
      named.parameters = {{"added", "kg", 10.0, 1.0}};
      report.causes = {named};
      return report;
    };
  }
};

TEST(StudyRun, KeepsEveryCaseAndGoesOnAfterAnInterruption) {
  const OwnFile own;
  const auto cases = someCases();
  ASSERT_EQ(cases.size(), 4U);
  FakeDiagnosis fake;
  {
    OutcomeFile file(own.path(), "one");
    const auto stop = [](const Step& step) {
      if (step.done == 2) throw std::runtime_error("interrupted");
    };
    EXPECT_THROW(runStudy(cases, fake.diagnoser(), 1, file, stop), std::runtime_error);
  }
  EXPECT_EQ(fake.asked, 2);
  OutcomeFile file(own.path(), "one");
  EXPECT_TRUE(file.notices().empty());
  std::size_t steps = 0;
  runStudy(cases, fake.diagnoser(), 2, file, [&](const Step& step) {
    EXPECT_EQ(step.of, 2U);
    steps = step.done;
  });
  EXPECT_EQ(fake.asked, 4);
  EXPECT_EQ(steps, 2U);
  for (const StudyCase& one : cases) {
    const auto outcome = OutcomeFile(own.path(), "one").find(one);
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->of.name(), one.name());
    EXPECT_EQ(outcome->answer.causes.at(0).numbers.at(0).sigma, 1.0);
    EXPECT_EQ(outcome->truth.items.size(), one.kind == Kind::kOne ? 1U : 0U);
    EXPECT_EQ(outcome->truth.ideal_limit > 0.0, one.kind == Kind::kOne);
  }
}

TEST(StudyRun, OneAndTwoThreadsGiveTheSame) {
  FakeDiagnosis fake;
  std::vector<std::string> made[2];
  for (int threads : {1, 2}) {
    const OwnFile own;
    OutcomeFile file(own.path(), "one");
    runStudy(someCases(), fake.diagnoser(), threads, file);
    for (const StudyCase& one : someCases()) {
      CaseOutcome outcome = *file.find(one);
      outcome.answer.seconds = 0.0;
      made[threads - 1].push_back(jsonOf(outcome).dump());
    }
  }
  EXPECT_EQ(made[0], made[1]);
}

TEST(StudyRun, ADiagnosisThatThrowsIsAnAnswer) {
  const OwnFile own;
  FakeDiagnosis fake;
  fake.fails_after = 0;
  OutcomeFile file(own.path(), "one");
  runStudy({someCases().front()}, fake.diagnoser(), 1, file, {}, {.ideal_limit = false});
  const auto outcome = file.find(someCases().front());
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->answer.verdict, "error");
  EXPECT_EQ(outcome->answer.summary, "no answer");
  EXPECT_EQ(scoreOne(*outcome).hit, Hit::kError);
}

TEST(OutcomeFile, ReadsBackToTheLastBit) {
  const OwnFile own;
  CaseOutcome outcome =
      backlashCase(answer("several", {cause("backlash", 2, {{"half_width", 0.1 / 3.0, NAN}})},
                          {{cause("slack", 2), cause("payload", 0)}}));
  outcome.answer.candidates = {{"slack", 2, NAN, 3.5}};
  outcome.truth.texture = {item("stribeck_friction", 2, 0.0, 0.02).planted};
  OutcomeFile(own.path(), "one").keep(outcome);
  const auto back = OutcomeFile(own.path(), "one").find(outcome.of);
  ASSERT_TRUE(back);
  EXPECT_EQ(jsonOf(*back).dump(), jsonOf(outcome).dump());
  EXPECT_EQ(back->answer.causes[0].numbers[0].value, 0.1 / 3.0);
  EXPECT_TRUE(std::isnan(back->answer.causes[0].numbers[0].sigma));
}

TEST(OutcomeFile, AnotherProgramsCasesAreLeftAside) {
  const OwnFile own;
  const CaseOutcome outcome = backlashCase(answer("nothing"));
  OutcomeFile(own.path(), "one").keep(outcome);
  OutcomeFile other(own.path(), "two");
  EXPECT_FALSE(other.find(outcome.of));
  EXPECT_TRUE(other.find(outcome.of, true));
  ASSERT_EQ(other.notices().size(), 1U);
  other.keep(backlashCase(answer("unexplained")));
  EXPECT_EQ(OutcomeFile(own.path(), "one").find(outcome.of)->answer.verdict, "nothing");
  EXPECT_EQ(OutcomeFile(own.path(), "two").find(outcome.of)->answer.verdict, "unexplained");
}

TEST(OutcomeFile, ALastLineThatIsNotWholeIsCutOff) {
  const OwnFile own;
  const CaseOutcome first = backlashCase(answer("nothing")), second = backlashCase(answer("found"), 0.5, 2);
  OutcomeFile(own.path(), "one").keep(first);
  const std::string whole = base::readTextFile(own.path());
  for (const std::size_t left : {std::size_t{1}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(own.path(), std::ios::binary) << whole << whole.substr(0, left);
    OutcomeFile file(own.path(), "one");
    ASSERT_EQ(file.notices().size(), 1U) << left;
    EXPECT_NE(file.notices()[0].find("cases.jsonl:2"), std::string::npos) << file.notices()[0];
    EXPECT_EQ(base::readTextFile(own.path()), whole);
    file.keep(second);
    const OutcomeFile again(own.path(), "one");
    EXPECT_TRUE(again.find(first.of) && again.find(second.of));
  }
}

TEST(OutcomeFile, DamageInTheMiddleIsRefusedWithItsLine) {
  const OwnFile own;
  OutcomeFile(own.path(), "one").keep(backlashCase(answer("nothing")));
  std::string line = base::readTextFile(own.path());
  std::string damaged = line;
  damaged.replace(damaged.find("\"nothing\""), 9, "\"notking\"");
  std::ofstream(own.path(), std::ios::binary) << line << damaged << line;
  try {
    OutcomeFile(own.path(), "one");
    FAIL() << "a damaged line was taken";
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().line, 2);
    EXPECT_NE(error.fault().reason.find("checksum"), std::string::npos);
    EXPECT_FALSE(error.fault().remedy.empty());
  }
}

TEST(StudyTables, AreWrittenForPeopleAndPrograms) {
  const OwnFile own;
  const Summary summary = summaryOf({backlashCase(answer("found", {cause("backlash", 2)})),
                                     backlashCase(answer("found", {cause("slack", 3)}), 0.2, 2)});
  writeTables(summary, own.folder());
  const std::string text = base::readTextFile(own.folder() / "study.md");
  EXPECT_NE(text.find("right name and joint first"), std::string::npos);
  EXPECT_NE(text.find("found; slack 3"), std::string::npos);
  const std::string confusion = base::readTextFile(own.folder() / "confusion.csv");
  EXPECT_EQ(confusion, "planted,backlash,slack\nbacklash,1,1\n");
  for (const char* name : {"goals", "effects", "groups", "misses", "outside"})
    EXPECT_TRUE(std::filesystem::exists(own.folder() / (std::string(name) + ".csv"))) << name;
}

}  // namespace
}  // namespace capstan::study
