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
  EXPECT_EQ(report.sent, 20U);
  EXPECT_EQ(report.skipped, 0U);
}

TEST(Player, SkipsImagesThatAreOverdue) {
  // A pair is read in 0.2 s and due every 0.05 s: the first one is late by 0.2 s, each further one by more.
  const ImagePlayReport report = played(6, 0.2);
  EXPECT_EQ(report.sent, 0U);
  EXPECT_EQ(report.skipped, 6U);
  EXPECT_EQ(report.pairs(), 6U);
}

TEST(Player, WhatFaultsWithholdIsNotSkipped) {
  const ImagePlayReport report = played(4, 0.2, {.faults = {parseImageFault("drop:1", "fault")}, .seed = 1});
  EXPECT_EQ(report.withheld, 4U);
  EXPECT_EQ(report.skipped, 0U);
}

}  // namespace
}  // namespace capstan::live
