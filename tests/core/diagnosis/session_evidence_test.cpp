// Evidence of sources and session files: each sensor at times of its own, tips from pictures.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/recording/export.h"
#include "core/recording/session_file.h"
#include "core/robot/kinematics.h"
#include "core/simulation/simulated_source.h"
#include "core/simulation/truth.h"
#include "core/vision/camera.h"
#include "tests/core/diagnosis/data_folder.h"

namespace capstan::diagnosis {
namespace {

simulation::SimulatedOptions options(double seconds, bool images) {
  simulation::SimulatedOptions options;
  options.robot = raven();
  options.truth = simulation::matchedTruth();
  options.trajectory.kind = simulation::TrajectoryKind::kSinusoid;
  options.trajectory.duration = seconds;
  options.rig =
      vision::readStereoRig(base::resource("cameras/left.yaml"), base::resource("cameras/right.yaml"));
  options.images = images;
  return options;
}

/// Root of the mean square distance of observations from where the joint encoders put the marker [m].
double tipError(const Evidence& evidence) {
  const robot::Chain chain(raven());
  double sum = 0.0, count = 0.0;
  for (const TipObservation& observation : evidence.tip) {
    robot::JointVector q(3);
    for (Eigen::Index j = 0; j < 3; ++j)
      q(j) = Evidence::at(evidence.q[static_cast<std::size_t>(j)], observation.row);
    if (!q.allFinite()) continue;
    sum += (chain.marker(q) - observation.position).squaredNorm(), count += 1.0;
  }
  return std::sqrt(sum / count);
}

TEST(SessionEvidence, TipsComeFromThePictures) {
  simulation::SimulatedSource source(options(3.0, true));
  const Evidence evidence = evidenceOf(source);
  EXPECT_NEAR(evidence.step, 1e-3, 1e-9);
  EXPECT_EQ(evidence.joints, 3);
  ASSERT_TRUE(evidence.robot.has_value());
  EXPECT_TRUE(evidence.hasEncoders());
  ASSERT_GE(evidence.tip.size(), 40U);
  EXPECT_LT(tipError(evidence), 3e-3);
  for (std::size_t i = 1; i < evidence.tip.size(); ++i) EXPECT_GT(evidence.tip[i].t, evidence.tip[i - 1].t);
}

TEST(SessionEvidence, ASessionFileGivesWhatItsSourceGave) {
  std::string name = (std::filesystem::temp_directory_path() / "capstan-evidence-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(name.data()), file = folder / "a.capstan";
  simulation::SimulatedSource recorded(options(6.0, false)), live(options(6.0, false));
  recording::importRecording(recorded, file, recording::headerOf(recorded.info(), "2026-01-01T00:00:00Z"));
  const Evidence from_file = readEvidence(file, raven()), from_source = evidenceOf(live);
  std::filesystem::remove_all(folder);
  EXPECT_EQ(from_file.t, from_source.t);
  EXPECT_EQ(from_file.q_m, from_source.q_m);
  EXPECT_EQ(from_file.q, from_source.q);
  ASSERT_EQ(from_file.tip.size(), from_source.tip.size());
  EXPECT_GE(from_file.tip.size(), 80U);
  EXPECT_EQ(from_file.file, file.string());
  EXPECT_LT(tipError(from_file), 3e-3);
}

TEST(SessionEvidence, ARecordingWithoutAnyReferenceIsRefused) {
  simulation::SimulatedOptions blind = options(2.0, false);
  blind.rig.reset();
  blind.joint_decimation = 0;
  simulation::SimulatedSource source(blind);
  try {
    evidenceOf(source);
    ADD_FAILURE() << "accepted";
  } catch (const base::InputError& error) {
    EXPECT_NE(error.fault().reason.find("neither joint encoders nor cameras"), std::string::npos);
  }
}

TEST(SessionEvidence, CamerasAloneWillDo) {
  simulation::SimulatedOptions seen = options(4.0, false);
  seen.joint_decimation = 0;
  simulation::SimulatedSource source(seen);
  const Evidence evidence = evidenceOf(source);
  EXPECT_FALSE(evidence.hasEncoders());
  EXPECT_GE(evidence.countingObservations(), 50U);
  for (const ChannelNoise& noise : evidence.noise.tip) EXPECT_GT(noise.sigma, 0.0);
}

}  // namespace
}  // namespace capstan::diagnosis
