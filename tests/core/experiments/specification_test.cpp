#include "core/experiments/specification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"

namespace capstan::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// What the reader says of `text`, line by line of a file x.yaml.
base::InputFault faultOf(const std::string& text) {
  try {
    (void)parseSpecification(text, "x.yaml");
  } catch (const base::InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted:\n" << text;
  return {};
}

TEST(Specification, TheFourExperimentsAreThere) {
  const Specification a = findSpecification("A"), b = findSpecification("B"), c = findSpecification("C"),
                      d = findSpecification("D");
  EXPECT_EQ(a.work, Work::kIdentify);
  EXPECT_THAT(b.needs(), ElementsAre("A"));
  EXPECT_THAT(c.needs(), ElementsAre("A", "B"));
  std::vector<double> durations, shares;
  for (const TrialSpec& trial : c.trials) durations.push_back(trial.duration);
  for (const TrialSpec& trial : d.trials) {
    shares.push_back(trial.occlusion.percentage);
    EXPECT_EQ(trial.occlusion.interval, 2.0);
    EXPECT_EQ(trial.seed, d.trials.front().seed);
  }
  EXPECT_THAT(durations, ElementsAre(188, 80, 150, 82, 110, 290));
  EXPECT_THAT(shares, ElementsAre(10, 20, 40, 60, 80));
  for (const Specification& one : {a, b, c, d})
    EXPECT_TRUE(std::filesystem::exists(one.resolved(one.truth))) << one.truth;
}

TEST(Specification, AMistakeIsNamedWithItsLine) {
  const std::string head = "name: x\nwork: track\n";
  base::InputFault fault = faultOf(head + "trials:\n  - {name: one}\n  - {name: two, duration: -3}\n");
  EXPECT_EQ(fault.file, "x.yaml");
  EXPECT_EQ(fault.line, 5);
  EXPECT_EQ(fault.key, "trials[1].duration");
  EXPECT_EQ(fault.value, "-3");

  fault = faultOf(head + "trials:\n  - {name: one}\n  - {name: one}\n");
  EXPECT_EQ(fault.line, 5);
  EXPECT_THAT(fault.reason, HasSubstr("two trials"));
  fault = faultOf(head + "trials:\n  - {name: 1 %}\n  - {name: 1}\n");
  EXPECT_EQ(fault.line, 5);

  fault = faultOf(head + "trials: []\n");
  EXPECT_EQ(fault.line, 3);
  EXPECT_EQ(fault.key, "trials");

  fault = faultOf(head + "trials:\n  - name: one\n    recording: a.capstan\n    seed: 4\n");
  EXPECT_EQ(fault.line, 6);
  EXPECT_THAT(fault.reason, HasSubstr("recording"));

  fault = faultOf(head + "robot: [my.yaml, A]\ntrials:\n  - {name: one}\n");
  EXPECT_EQ(fault.line, 3);
  EXPECT_EQ(fault.key, "robot[0]");
  fault = faultOf(head + "robot: [x]\ntrials:\n  - {name: one}\n");
  EXPECT_THAT(fault.reason, HasSubstr("itself"));

  fault = faultOf("name: ../up\nwork: track\ntrials:\n  - {name: one}\n");
  EXPECT_EQ(fault.line, 1);
  fault = faultOf("name: x\nwork: track\nidentification: {parameters: r_l}\ntrials:\n  - {name: one}\n");
  EXPECT_EQ(fault.line, 3);
  fault = faultOf("name: x\nwork: track\ntrails:\n  - {name: one}\n");
  EXPECT_FALSE(fault.remedy.empty());
}

TEST(Specification, NamesOfFilesAreRelativeToItsFolder) {
  const Specification c = findSpecification("C");
  EXPECT_EQ(std::filesystem::path(c.resolved("fls.yaml")), c.file.parent_path() / "fls.yaml");
  EXPECT_EQ(c.resolved("sinusoid"), "sinusoid");
  EXPECT_EQ(c.resolved("/tmp/x.csv"), "/tmp/x.csv");
}

TEST(Specification, AnUnknownExperimentIsRefused) {
  const auto remedyOf = [](const std::string& name, const std::filesystem::path& beside) {
    try {
      (void)findSpecification(name, beside);
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().value, name);
      return error.fault().remedy;
    }
    ADD_FAILURE() << "found " << name;
    return std::string();
  };
  EXPECT_EQ(remedyOf("mine", {}), "Give A, B, C, D, all, or a specification (mine.yaml)");
  EXPECT_EQ(remedyOf("E", "/nowhere/c.yaml"), "Give A, B, C, D, or put E.yaml beside the specification");
}

}  // namespace
}  // namespace capstan::experiments
