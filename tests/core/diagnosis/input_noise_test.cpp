// Noise of load cells, and torques between the rows, come through the simulation as large as they are;
// effects are not named for them.
#include "core/diagnosis/fit/input_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/horizons.h"
#include "tests/support/folders.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

/// A sound rigid axis under loads that are measured with noise, and its refitted nominal structure. Its motor
/// has another torque every millisecond.
struct Sound {
  robot::Description robot =
      robot::readDescription(test::sourceFile("tests/support/planted/data/rigid_axis.yaml"));
  std::vector<Evidence> evidence;

  explicit Sound(double load_sigma, int row_period = 1, std::uint64_t seed = 5) {
    test::DrawOptions options;
    options.robot = robot;
    options.rigid = true;
    options.effects = 0;
    options.duration = 20.0;
    test::PlantedCase drawn = test::draw(seed, options);
    drawn.sensors.load_cells = true;
    drawn.sensors.load_sigma = load_sigma;
    drawn.sensors.row_period = row_period;
    evidence.push_back(evidenceOf(test::record(drawn).table, robot));
  }

  Selection refitted(const FitData& data) const {
    SearchOptions options;
    options.most_causes = 0;
    return select(data, evidence, FitModel(robot, jointScales(evidence, robot)), nullptr, options, nullptr);
  }
};

TEST(InputNoise, IsWhatARefittedRobotLeavesBeyondItsEncoders) {
  const Sound sound(0.4);
  const FitData data(sound.evidence, sound.robot, kHorizons[1], EncoderZeros::kKnown, 2);
  const Selection s = sound.refitted(data);
  const double sensor = data.channels()[0].noise, input = s.input_noise.rms[0];
  const BlockSquares squares = squaresOf(data, s.base.e);
  const double left = std::sqrt(squares.sum.row(0).sum() / squares.count.row(0).sum());
  EXPECT_GT(input, sensor);
  EXPECT_GT(left, 0.6 * std::hypot(sensor, input));
  EXPECT_LT(left, 1.5 * std::hypot(sensor, input));
}

TEST(InputNoise, IsNextToNothingBehindGoodLoadCells) {
  const Sound sound(1e-5);
  const FitData data(sound.evidence, sound.robot, kHorizons[1], EncoderZeros::kKnown, 2);
  const Selection s = sound.refitted(data);
  EXPECT_LT(s.input_noise.rms[0], 0.2 * data.channels()[0].noise);
}

TEST(InputNoise, HasAsManyIndependentReadingsAsRecordingsOfOneAxisShow) {
  constexpr int kRecordings = 12;
  double squares = 0.0, expected = 0.0;
  for (int seed = 1; seed <= kRecordings; ++seed) {
    const Sound sound(4.0, 1, static_cast<std::uint64_t>(seed));
    const FitData data(sound.evidence, sound.robot, kHorizons[1], EncoderZeros::kKnown, 2);
    const Selection s = sound.refitted(data);
    const double left = squaresOf(data, s.base.e).meanSquare(0);
    const double noise = std::pow(data.channels()[0].noise, 2) + std::pow(s.input_noise.rms[0], 2);
    squares += std::pow(left / noise - 1.0, 2);
    expected += 2.0 * s.input_noise.correlation[0] / static_cast<double>(data.size());
  }
  EXPECT_GT(squares, 0.4 * expected);
  EXPECT_LT(squares, 2.5 * expected);
}

TEST(InputNoise, IsNoEffect) {
  const Sound sound(0.4);
  DiagnosisOptions options;
  options.show = false;
  EXPECT_EQ(diagnose(sound.evidence, sound.robot, options).verdict, Verdict::kNothing);
}

TEST(TorqueNoise, IsWhatARefittedRobotLeavesWhereTorquesAreNotRecorded) {
  for (const int period : {1, 2}) {
    const Sound sound(1e-5, period);
    const FitData data(sound.evidence, sound.robot, kHorizons[1], EncoderZeros::kKnown, 2);
    const Selection s = sound.refitted(data);
    const double sensor = data.channels()[0].noise, torque = s.torque_noise.rms[0];
    const double left = std::sqrt(squaresOf(data, s.base.e).meanSquare(0));
    EXPECT_GT(torque, 0.5 * sensor);
    EXPECT_LT(left, 1.2 * std::hypot(sensor, period == 1 ? 0.0 : torque)) << period;
    EXPECT_TRUE(period == 1 || left > 1.2 * sensor) << left / sensor;
  }
}

TEST(TorqueNoise, IsNoEffectAndNothingUnexplained) {
  const Sound sound(1e-5, 2);
  DiagnosisOptions options;
  options.show = false;
  options.material = {0.0, 0.0};
  EXPECT_EQ(diagnose(sound.evidence, sound.robot, options).verdict, Verdict::kNothing);
}

}  // namespace
}  // namespace capstan::diagnosis
