#include "core/simulation/truth.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/folders.h"

namespace capstan::simulation {
namespace {

const std::string kFolder = test::resourceFile("truth/");

TEST(Truth, ShippedFilesAreTheBuiltInTruths) {
  EXPECT_EQ(formatTruth(readTruth(kFolder + "default.yaml")), formatTruth(defaultTruth()));
  EXPECT_EQ(formatTruth(readTruth(kFolder + "matched.yaml")), formatTruth(matchedTruth()));
}

TEST(Truth, TextReadsBackToTheLastBit) {
  Truth truth = defaultTruth();
  truth.joints[1].link_radius = 0.1 / 3.0;
  truth.cameras.rotation_error = {1.0 / 7.0, -1e-9, 0.0};
  const Truth again = parseTruth(formatTruth(truth), "again");
  EXPECT_EQ(formatTruth(again), formatTruth(truth));
  EXPECT_EQ(*again.joints[1].link_radius, 0.1 / 3.0);
  EXPECT_EQ(again.cameras.rotation_error, truth.cameras.rotation_error);
}

TEST(Truth, AnEmptyFileIsTheMatchedRobotWithIdealSensors) {
  EXPECT_EQ(formatTruth(parseTruth("{}", "empty")), formatTruth(Truth{}));
  EXPECT_FALSE(Truth{}.joints[0].link_radius);
  EXPECT_EQ(Truth{}.joints[2].hysteresis.stiffness, 0.0);
  EXPECT_EQ(Truth{}.images.noise, 0.0);
  EXPECT_FALSE(Truth{}.encoders.motor_quantised);
}

TEST(Truth, MistakesNameLineKeyAndValue) {
  try {
    parseTruth("name: x\ncameras:\n  latency: -1\n", "bad.yaml");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "bad.yaml");
    EXPECT_EQ(error.fault().line, 3);
    EXPECT_EQ(error.fault().key, "cameras.latency");
    EXPECT_EQ(error.fault().value, "-1");
  }
  EXPECT_THROW(parseTruth("joints: [{}, {}]\n", "bad.yaml"), base::InputError);
  EXPECT_THROW(parseTruth("camera: {}\n", "bad.yaml"), base::InputError);
}

}  // namespace
}  // namespace capstan::simulation
