/// Images of a recording that a computer cannot serve in time.
#include "core/live/player.h"

#include <gtest/gtest.h>

#include <thread>

namespace capstan::live {
namespace {

/// Pairs of images at 20 per second, of which each takes `effort` [s] to read.
class Pairs final : public tracking::Source {
 public:
  Pairs(int count, double effort) : count_(count), effort_(effort) {}
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    if (taken_ == count_) return false;
    std::this_thread::sleep_for(std::chrono::duration<double>(effort_));
    const double t = 0.05 * taken_++;
    const cv::Mat image(8, 8, CV_8UC3, cv::Scalar(0, 0, 0));
    out = tracking::StereoFrame{t, t, image, image};
    return true;
  }
  void block(bool, bool) override {}

 private:
  const int count_;
  const double effort_;
  int taken_ = 0;
  tracking::SourceInfo info_;
};

ImagePlayReport played(int count, double effort, const PlayOptions& options = {}) {
  Pairs pairs(count, effort);
  ImageServer server("127.0.0.1", 0);
  return playImages(pairs, server, PlayClock{}, options, nullptr);
}

TEST(Player, ServesImagesThatAreInTime) {
  const ImagePlayReport report = played(20, 0.0);
  EXPECT_GT(report.sent - report.late, 0U);  // on a busy computer not all are
  EXPECT_EQ(report.pairs(), 20U);
}

/// A pair is read in 0.08 s and due every 0.05 s: each is later than the one before by 0.03 s.
TEST(Player, SkipsImagesThatAreOverdueButForOneInAWhile) {
  const ImagePlayReport report = played(16, 0.08);
  EXPECT_GE(report.skipped, 4U);
  EXPECT_GE(report.late, 3U) << "the stream goes on";
  EXPECT_GE(report.sent, report.late);
  EXPECT_EQ(report.pairs(), 16U);
}

TEST(Player, WhatFaultsWithholdIsNotSkipped) {
  const ImagePlayReport report = played(4, 0.2, {.faults = {parseImageFault("drop:1", "fault")}, .seed = 1});
  EXPECT_EQ(report.withheld, 4U);
  EXPECT_EQ(report.skipped, 0U);
}

}  // namespace
}  // namespace capstan::live
