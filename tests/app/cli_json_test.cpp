// Keys of --json documents are identifiers, and each stands on the manual's page.
#include <gmock/gmock.h>

#include <cctype>
#include <set>

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "tests/app/cli_fixture.h"
#include "tests/app/diagnose_recording.h"
#include "tests/support/sample_poses.h"

namespace capstan::testing {
namespace {

void collectKeys(const json& document, std::set<std::string>& keys) {
  if (document.is_object())
    for (const auto& [key, value] : document.items()) {
      keys.insert(key);
      collectKeys(value, keys);
    }
  if (document.is_array())
    for (const json& value : document) collectKeys(value, keys);
}

/// Names of columns, parameters and refitted numbers are the robot's.
bool isOfTheRobot(const std::string& key) {
  return std::isdigit(static_cast<unsigned char>(key.back())) && key.find("95") == std::string::npos;
}

class CliJson : public Cli {
 protected:
  void expectDescribed(const std::string& command) {
    const Ran ran = run(command + " --json -");
    ASSERT_EQ(ran.exit, 0) << ran.err;
    const json document = json::parse(ran.out);
    EXPECT_EQ(document.at("schema"), 1) << command;
    std::set<std::string> keys;
    collectKeys(document, keys);
    const std::string page = base::readTextFile(base::resource("manual/json.md"));
    for (const std::string& key : keys) {
      EXPECT_EQ(key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << key;
      if (isOfTheRobot(key)) continue;
      EXPECT_NE(page.find(key), std::string::npos) << command << ": " << key;
    }
  }
};

TEST_F(CliJson, OfTrackingIdentifyingAndInfo) {
  const std::string file =
      simulate("s.capstan", "--no-images --duration 12 --trajectory sinusoid --truth matched");
  expectDescribed("track " + file);
  expectDescribed("info " + file);
  expectDescribed("identify " + file + " --parameters r_l1");
  EXPECT_EQ(run("convert " + file + " " + path("t.csv")).exit, 0);
  expectDescribed("info " + path("t.csv"));
}

TEST_F(CliJson, OfDiagnosing) {
  writeRecording(path("slow.csv"), {.duration = 8.0});
  expectDescribed("diagnose " + path("slow.csv") + " --only backlash");
}

TEST_F(CliJson, OfLearningAndDrift) {
  writeSamplePoses(path("train.csv"));
  SamplePoses later;
  later.seed = 2;
  writeSamplePoses(path("later.csv"), later);
  expectDescribed("learn --train " + path("train.csv") + " --test " + path("later.csv") +
                  " --method velocity --members 1 --inducing 60 --hold-out 20 --model " +
                  path("m.correction"));
  expectDescribed("drift --model " + path("m.correction") + " " + path("later.csv"));
}

}  // namespace
}  // namespace capstan::testing
