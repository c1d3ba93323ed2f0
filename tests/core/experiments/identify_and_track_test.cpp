#include "core/experiments/identify_and_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <variant>

#include "core/simulation/simulation_request.h"

namespace capstan::experiments {
namespace {

using ::testing::HasSubstr;

std::unique_ptr<simulation::SimulatedSource> simulated(bool cameras = true) {
  simulation::SimulationRequest request;
  request.duration = 15.0;
  request.images = false;
  request.cameras_fitted = cameras;
  return std::make_unique<simulation::SimulatedSource>(simulation::optionsOf(request));
}

/// A recording from which truth and joint encoders have been taken.
class Blind final : public tracking::Source {
 public:
  explicit Blind(std::unique_ptr<tracking::Source> source)
      : source_(std::move(source)), info_(source_->info()) {
    info_.truth.clear();
    info_.reference = false;
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    while (source_->next(out))
      if (!std::holds_alternative<tracking::JointSample>(out)) return true;
    return false;
  }
  void block(bool left, bool right) override { source_->block(left, right); }

 private:
  std::unique_ptr<tracking::Source> source_;
  tracking::SourceInfo info_;
};

IdentifyAndTrack after(tracking::Source& first, tracking::Source& second, base::Progress& progress) {
  const identification::IdentificationData data = identification::collect(first);
  return identifyAndTrack(data, second, {}, progress);
}

TEST(IdentifyAndTrack, FindsTheSameWithoutTruthAndJointEncoders) {
  base::Progress progress;
  const auto first = simulated(), second = simulated();
  const IdentifyAndTrack known = after(*first, *second, progress);
  Blind one(simulated()), two(simulated());
  const IdentifyAndTrack blind = after(one, two, progress);
  ASSERT_EQ(known.fault, "");
  ASSERT_EQ(blind.fault, "");
  ASSERT_TRUE(known.tracked && blind.tracked);
  for (std::size_t i = 0; i < known.identified->estimates().size(); ++i) {
    EXPECT_EQ(blind.identified->estimates()[i].log, known.identified->estimates()[i].log);
    EXPECT_EQ(blind.identified->estimates()[i].sigma, known.identified->estimates()[i].sigma);
  }
  EXPECT_EQ(blind.tracked->nisMean(), known.tracked->nisMean());
  EXPECT_EQ(blind.tracked->errors.ukf().count(), 0U);
  EXPECT_GT(known.tracked->errors.ukf().count(), 14000U);
  // The plant's pulley is 59 mm where the robot file says 63.095 mm.
  EXPECT_NEAR(known.identified->robot().drives[0].link_radius, 0.059, 0.0006);
  EXPECT_EQ(progress.fraction(), 1.0);
}

TEST(IdentifyAndTrack, SaysWhyNothingWasIdentified) {
  base::Progress progress;
  const auto first = simulated(false), second = simulated(false);
  const IdentifyAndTrack result = after(*first, *second, progress);
  EXPECT_THAT(result.fault, HasSubstr("the cameras saw the marker nowhere"));
  EXPECT_FALSE(result.identified);
  EXPECT_FALSE(result.tracked);
  EXPECT_FALSE(result.cancelled);
}

TEST(IdentifyAndTrack, IsCancelledAtOnce) {
  const auto first = simulated(), second = simulated();
  const identification::IdentificationData data = identification::collect(*first);
  base::Progress progress;
  std::jthread stop([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    progress.cancel();
  });
  const IdentifyAndTrack result = identifyAndTrack(data, *second, {}, progress);
  EXPECT_TRUE(result.cancelled);
  EXPECT_FALSE(result.tracked);
}

}  // namespace
}  // namespace capstan::experiments
