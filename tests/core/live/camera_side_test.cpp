/// Cameras from video files and a network stream of this computer, with motors over TCP.
#include "core/live/camera_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/live/cameras/image_server.h"
#include "core/live/cameras/video_stream.h"
#include "core/tracking/side_text.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;

TEST(VideoStream, TakesTheDriversTimeOfTheMonotonicClockOnly) {
  const auto read = std::chrono::steady_clock::time_point(std::chrono::hours(5));
  const double read_ms = 5 * 3.6e6;
  using std::chrono::milliseconds;
  EXPECT_EQ(driverTime(read_ms - 40.0, read), read - milliseconds(40));
  EXPECT_EQ(driverTime(read_ms, read), read);
  for (const double other : {0.0, -1.0, read_ms - 1500.0, read_ms + 5.0, 1.7e12, std::nan("")})
    EXPECT_EQ(driverTime(other, read), read) << other;
}

/// A video of a white disc whose column tells the frame, left and right side by side.
class CameraSideOfAVideo : public ::testing::Test {
 protected:
  CameraSideOfAVideo()
      : path_(std::filesystem::temp_directory_path() /
              ("capstan_camera_" + std::to_string(getpid()) + ".avi")) {
    cv::VideoWriter writer(path_.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 30.0, {128, 48});
    for (int k = 0; k < kFrames; ++k) {
      cv::Mat both(48, 128, CV_8UC3, cv::Scalar::all(20));
      cv::circle(both, {10 + k, 24}, 5, cv::Scalar::all(255), cv::FILLED);
      cv::circle(both, {64 + 5 + k, 24}, 5, cv::Scalar::all(255), cv::FILLED);
      writer.write(both);
    }
  }
  ~CameraSideOfAVideo() override { std::filesystem::remove(path_); }
  CamerasSetup setup() const {
    CamerasSetup setup;
    setup.left = path_.string();
    setup.layout = CameraLayout::kSideBySide;
    setup.latency = 0.02;
    return setup;
  }
  static double columnOf(const cv::Mat& bgr) {
    cv::Mat grey;
    cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
    const cv::Moments moments = cv::moments(grey > 128, true);
    return moments.m10 / moments.m00;
  }

  static constexpr int kFrames = 30;
  std::filesystem::path path_;
};

TEST_F(CameraSideOfAVideo, GivesPairsAtTheVideosRate) {
  SampleQueue queue(1000, kFrames);
  const auto start = CameraSide::Clock::now();
  const auto since = [&](CameraSide::Clock::time_point at) -> std::optional<double> {
    return std::chrono::duration<double>(at - start).count();
  };
  CameraSide cameras(setup(), {since, {}, {}, {}}, queue);
  for (int k = 0; k < kFrames; ++k) {
    ASSERT_TRUE(queue.ready(2s)) << k;
    tracking::Sample sample;
    queue.take(sample);
    const auto& frame = std::get<tracking::StereoFrame>(sample);
    ASSERT_EQ(frame.left.size(), cv::Size(64, 48));
    EXPECT_NEAR(columnOf(frame.left), 10 + k, 0.5);
    EXPECT_NEAR(columnOf(frame.right), 5 + k, 0.5);
    EXPECT_NEAR(frame.t, k / 30.0 - 0.02, 1e-3) << "its time in the file, minus the stated latency";
    EXPECT_GE(frame.t_arrival - frame.t, 0.02) << "not before its time";
  }
  const double seconds = std::chrono::duration<double>(CameraSide::Clock::now() - start).count();
  EXPECT_GT(seconds, 0.9) << "30 frames at 30 frames/s";
  EXPECT_EQ(cameras.status().received, static_cast<std::uint64_t>(kFrames));
  EXPECT_EQ(cameras.status().dropped, 0U);
}

/// The computer stalls at 0.2 s for 0.5 s.
TEST_F(CameraSideOfAVideo, ImagesThatAreLateArePassedOver) {
  SampleQueue queue(1000, kFrames);
  const auto start = CameraSide::Clock::now();
  const auto since = [&](CameraSide::Clock::time_point at) -> std::optional<double> {
    const double seconds = std::chrono::duration<double>(at - start).count();
    return seconds + (seconds > 0.2 ? 0.5 : 0.0);
  };
  CameraSide cameras(setup(), {since, {}, {}, {}}, queue);
  int images = 0;
  double last = 0.0;
  while (queue.ready(500ms)) {
    tracking::Sample sample;
    queue.take(sample);
    const auto& frame = std::get<tracking::StereoFrame>(sample);
    const long k = std::lround(30.0 * (frame.t + 0.02));
    EXPECT_NEAR(columnOf(frame.left), 10 + static_cast<double>(k), 0.5) << "the image of its time";
    EXPECT_LT(frame.t_arrival - frame.t, 0.02 + 0.3 + 0.1) << k << ", a tenth for a busy machine";
    last = frame.t;
    ++images;
  }
  EXPECT_NEAR(last, (kFrames - 1) / 30.0 - 0.02, 1e-3) << "to the end";
  EXPECT_GT(cameras.status().dropped, 5U) << "of 15 in the stall";
  EXPECT_EQ(images + static_cast<int>(cameras.status().dropped), kFrames);
}

TEST_F(CameraSideOfAVideo, ASkipLeadsToTheImageOfItsTime) {
  for (const double rate : {0.0, 15.0}) {
    VideoSettings settings;
    settings.rate = rate;
    VideoStream video(path_.string(), settings);
    const double period = 1.0 / (rate > 0.0 ? rate : 30.0);
    cv::Mat image;
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(video.read(image));
    EXPECT_EQ(video.skip(10.5 * period), 10);
    ASSERT_TRUE(video.read(image));
    EXPECT_NEAR(video.position(), 13 * period, 1e-3);
    EXPECT_NEAR(columnOf(image.colRange(0, 64)), 10 + 13, 0.5);
    EXPECT_EQ(video.skip(-1.0), 0);
  }
}

TEST_F(CameraSideOfAVideo, BeginsWithTheSession) {
  SampleQueue queue(1000, kFrames);
  std::atomic<bool> begun = false;
  CameraSide cameras(
      setup(),
      {[&](CameraSide::Clock::time_point) { return begun ? std::optional(1.0) : std::nullopt; },
       {},
       [] { return 1.0; },
       {}},
      queue);
  EXPECT_FALSE(queue.ready(300ms));
  EXPECT_EQ(cameras.status().received, 0U);
  begun = true;
  ASSERT_TRUE(queue.ready(2s));
  tracking::Sample sample;
  queue.take(sample);
  EXPECT_NEAR(columnOf(std::get<tracking::StereoFrame>(sample).left), 10, 0.5) << "the first image";
}

/// The first rows come in a portion, so that the session's clock is ahead when the file begins.
TEST_F(CameraSideOfAVideo, TimesAreThoseOfTheFileAfterTheFirstSample) {
  SampleQueue queue(1000, kFrames);
  constexpr double kBegin = 7.0, kAhead = 0.065;
  const auto start = CameraSide::Clock::now();
  const auto since = [&](CameraSide::Clock::time_point at) -> std::optional<double> {
    return kBegin + kAhead + std::chrono::duration<double>(at - start).count();
  };
  CameraSide cameras(setup(), {since, {}, [] { return kBegin; }, {}}, queue);
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(queue.ready(2s)) << k;
    tracking::Sample sample;
    queue.take(sample);
    EXPECT_NEAR(std::get<tracking::StereoFrame>(sample).t, kBegin + k / 30.0 - 0.02, 1e-3) << k;
  }
}

TEST_F(CameraSideOfAVideo, NoImageComesBeforeItsExposure) {
  SampleQueue queue(1000, kFrames);
  const auto start = CameraSide::Clock::now();
  const auto since = [&](CameraSide::Clock::time_point at) -> std::optional<double> {
    return std::chrono::duration<double>(at - start).count();
  };
  CamerasSetup later = setup();
  later.latency = -0.2;  // the file begins 0.2 s after the rows
  CameraSide cameras(later, {since, {}, {}, {}}, queue);
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(queue.ready(2s)) << k;
    tracking::Sample sample;
    queue.take(sample);
    const auto& frame = std::get<tracking::StereoFrame>(sample);
    EXPECT_NEAR(frame.t, 0.2 + k / 30.0, 1e-3) << k;
    EXPECT_GE(frame.t_arrival, frame.t) << k;
  }
}

/// Rows come in portions: the clock is ahead of the newest one.
TEST_F(CameraSideOfAVideo, NoImageComesBeforeTheMotorsOfItsExposure) {
  SampleQueue queue(1000, kFrames);
  const auto start = CameraSide::Clock::now();
  const auto now = [&] { return std::chrono::duration<double>(CameraSide::Clock::now() - start).count(); };
  const auto since = [&](CameraSide::Clock::time_point at) -> std::optional<double> {
    return std::chrono::duration<double>(at - start).count();
  };
  const auto newest = [&] { return 0.1 * std::floor(10.0 * now()); };
  CamerasSetup exact = setup();
  exact.latency = 0.0;
  CameraSide cameras(exact, {since, {}, {}, newest}, queue);
  for (int k = 0; k < 12; ++k) {
    ASSERT_TRUE(queue.ready(2s)) << k;
    tracking::Sample sample;
    queue.take(sample);
    const auto& frame = std::get<tracking::StereoFrame>(sample);
    EXPECT_GE(std::floor(10.0 * frame.t_arrival + 1e-6), 10.0 * frame.t - 1e-6) << k;
  }
}

/// A session that began at `start`.
CameraSide::SessionClock clockSince(CameraSide::Clock::time_point start) {
  return {[start](CameraSide::Clock::time_point t) -> std::optional<double> {
            return std::chrono::duration<double>(t - start).count();
          },
          {},
          {},
          {}};
}

/// Two network cameras whose images the test publishes, thirty times a second.
class NetworkCameras : public ::testing::Test {
 protected:
  void SetUp() override {
    CamerasSetup setup;
    const std::string at = "http://127.0.0.1:" + std::to_string(server_.port());
    setup.left = at + "/left", setup.right = at + "/right";
    cameras_.emplace(setup, clockSince(start_), queue_);
  }
  cv::Mat newImage() {
    cv::Mat image(48, 64, CV_8UC3);
    cv::randu(image, 0, 255);
    return image;
  }
  /// Whether the side's state is reached while `publish` is called at the rate of a camera.
  bool reaches(tracking::SideStatus::State state, const std::function<void()>& publish) {
    for (int k = 0; k < 300 && cameras_->status().state != state; ++k) {
      publish();
      std::this_thread::sleep_for(33ms);
      tracking::Sample sample;
      while (queue_.ready(0ms)) queue_.take(sample);
    }
    return cameras_->status().state == state;
  }

  void expectTimesByStamps(std::chrono::duration<double> least);

  using State = tracking::SideStatus::State;
  ImageServer server_{"127.0.0.1", 0};
  SampleQueue queue_{1000};
  const CameraSide::Clock::time_point start_ = CameraSide::Clock::now();
  std::optional<CameraSide> cameras_;
};

/// Images that come late, each by `least` and up to 80 ms more, with the stamps of this computer's clock.
void NetworkCameras::expectTimesByStamps(std::chrono::duration<double> least) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> late(0.0, 0.08);
  std::vector<double> exposures;
  for (int k = 0, frames = 0; frames < 20; ++k) {
    ASSERT_LT(k, 300);
    const auto seconds = std::chrono::duration<double>(CameraSide::Clock::now() - start_) - least;
    exposures.push_back(seconds.count());
    const std::chrono::nanoseconds since = std::chrono::system_clock::now().time_since_epoch() -
                                           std::chrono::round<std::chrono::nanoseconds>(least);
    std::this_thread::sleep_for(std::chrono::duration<double>(late(random)));
    server_.publish(newImage(), newImage(), since.count());
    if (!queue_.ready(100ms)) continue;
    tracking::Sample sample;
    queue_.take(sample);
    const auto& frame = std::get<tracking::StereoFrame>(sample);
    const auto nearest =
        std::ranges::min_element(exposures, {}, [&](double t) { return std::abs(t - frame.t); });
    EXPECT_NEAR(frame.t, *nearest, 1e-3) << "the arrivals are later by up to 80 ms more";
    EXPECT_GT(frame.t_arrival - frame.t, least.count() - 1e-3);
    EXPECT_EQ(frame.skew, 0.0);
    ++frames;
  }
  EXPECT_EQ(cameras_->status().unpaired + cameras_->status().undated, 0U);
}

TEST_F(NetworkCameras, StampsAreTheTimes) { expectTimesByStamps(10ms); }
TEST_F(NetworkCameras, StampsAreTheTimesOfImagesThatAreLateFromTheFirstOne) { expectTimesByStamps(500ms); }

/// The clock of the cameras is ahead: until that is known, no image has a time.
TEST_F(NetworkCameras, StampsOfAClockThatIsAheadAreNotTheTimes) {
  int frames = 0;
  for (int k = 0; k < 300 && frames < 5; ++k) {
    const std::chrono::nanoseconds ahead = std::chrono::system_clock::now().time_since_epoch() + 1s;
    server_.publish(newImage(), newImage(), ahead.count());
    std::this_thread::sleep_for(33ms);
    const bool dated = cameras_->status().times.has_value();
    EXPECT_TRUE(!dated || frames > 0 || queue_.ready(0ms)) << "none has a time";
    for (tracking::Sample sample; queue_.ready(0ms); ++frames) {
      queue_.take(sample);
      const auto& frame = std::get<tracking::StereoFrame>(sample);
      EXPECT_NEAR(frame.t, frame.t_arrival, 0.2);
    }
  }
  EXPECT_EQ(frames, 5);
  EXPECT_EQ(cameras_->status().times, tracking::SideStatus::Times::kArrivals);
  EXPECT_GT(cameras_->status().undated, 10U);
}

/// A relay sends the images of a second at once when the session begins, and after a silence.
TEST_F(NetworkCameras, WithoutStampsImagesThatHaveWaitedAreNotUsed) {
  for (const int round : {1, 2}) {
    const auto begin = CameraSide::Clock::now();
    const auto passed = [&] {
      return std::chrono::duration<double>(CameraSide::Clock::now() - begin).count();
    };
    int frames = 0;
    for (bool burst = true; frames < 5 && passed() < 20.0; burst = passed() < 0.3) {
      server_.publish(newImage(), newImage());
      std::this_thread::sleep_for(burst ? 5ms : 33ms);
      for (tracking::Sample sample; queue_.ready(0ms); ++frames) {
        queue_.take(sample);
        EXPECT_GT(passed(), 0.4) << round;
      }
    }
    EXPECT_EQ(frames, 5) << round;
    std::this_thread::sleep_for(500ms);
  }
  EXPECT_EQ(cameras_->status().unpaired, 0U);
  EXPECT_EQ(cameras_->status().dropped, 0U);
}

/// The right one's address is wrong.
TEST_F(NetworkCameras, TheReasonIsThatOfTheCameraThatIsSilent) {
  CamerasSetup setup;
  setup.left = "http://user:secret@127.0.0.1:" + std::to_string(server_.port()) + "/left";
  setup.right = "http://user:secret@127.0.0.1:1/right";
  cameras_.emplace(setup, clockSince(start_), queue_);
  std::string reason;
  for (int k = 0; k < 300 && reason.empty(); ++k) {
    server_.publish(newImage(), newImage());
    std::this_thread::sleep_for(33ms);
    if (cameras_->status().received > 0) reason = cameras_->status().reason;
  }
  const tracking::SideStatus status = cameras_->status();
  EXPECT_EQ(status.state, State::kSilent);
  EXPECT_EQ(status.part, "right");
  EXPECT_EQ(reason.find("http://127.0.0.1:1/right: no server answers there"), 0U) << reason;
  EXPECT_EQ(status.from.find("secret"), std::string::npos) << status.from;
}

TEST_F(NetworkCameras, TheCameraThatIsSilentIsNamed) {
  ASSERT_TRUE(reaches(State::kReceiving, [&] { server_.publish(newImage(), newImage()); }));
  ASSERT_TRUE(reaches(State::kSilent, [&] { server_.publish(newImage(), {}); }));
  EXPECT_EQ(cameras_->status().part, "right");
  EXPECT_GT(cameras_->status().silent_for, tracking::SideStatus::kSilence);
  EXPECT_NE(tracking::shortTextOf(cameras_->status()).find("right camera silent for 0."), std::string::npos);
  ASSERT_TRUE(reaches(State::kReceiving, [&] { server_.publish(newImage(), newImage()); }));
  EXPECT_EQ(cameras_->status().part, "");
}

TEST_F(NetworkCameras, TheCameraThatIsFrozenIsNamed) {
  const cv::Mat frozen = newImage();
  ASSERT_TRUE(reaches(State::kReceiving, [&] { server_.publish(newImage(), newImage()); }));
  ASSERT_TRUE(reaches(State::kFrozen, [&] { server_.publish(frozen, newImage()); }));
  EXPECT_EQ(cameras_->status().part, "left");
  ASSERT_TRUE(reaches(State::kReceiving, [&] { server_.publish(newImage(), newImage()); }));
  ASSERT_TRUE(reaches(State::kFrozen, [&] { server_.publish(frozen, frozen); }));
  EXPECT_EQ(cameras_->status().part, "") << "both are";
}

TEST(CameraSide, RefusesWhatIsNoCamera) {
  CamerasSetup setup;
  setup.left = "/dev/video97", setup.right = "/dev/video98";
  SampleQueue queue(10);
  try {
    CameraSide cameras(setup, {}, queue);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "/dev/video97");
  }
}

}  // namespace
}  // namespace capstan::live
