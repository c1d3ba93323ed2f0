/// Images served over HTTP, received by FFmpeg as from any network camera.
#include "core/live/cameras/image_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <opencv2/core.hpp>
#include <thread>

#include "core/base/error.h"
#include "core/live/cameras/video_stream.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;

/// Image k of a camera: its grey level counts, from `first` on.
cv::Mat imageOf(int k, int first) { return {48, 64, CV_8UC3, cv::Scalar::all((first + k) % 256)}; }

int levelOf(const cv::Mat& image) { return static_cast<int>(std::lround(cv::mean(image)[0])); }

class Served : public ::testing::Test {
 protected:
  Served() : server_("127.0.0.1", 0), thread_([this] { serve(); }) {}
  ~Served() override {
    quit_ = true;
    thread_.join();
  }
  std::string at(const std::string& path) const {
    return "http://127.0.0.1:" + std::to_string(server_.port()) + path;
  }

  ImageServer server_;

 private:
  void serve() {
    for (int k = 0; !quit_; ++k) {
      server_.publish(imageOf(k, 0), imageOf(k, 100));
      std::this_thread::sleep_for(20ms);
    }
  }
  std::atomic<bool> quit_{false};
  std::thread thread_;
};

TEST_F(Served, EachEyeAndBothComeInOrder) {
  VideoStream left(at("/left"), {}), both(at("/both"), {});
  cv::Mat image;
  int last = -1;
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(left.read(image));
    ASSERT_EQ(image.size(), cv::Size(64, 48));
    EXPECT_GT(levelOf(image), last);
    last = levelOf(image);
  }
  ASSERT_TRUE(both.read(image));
  ASSERT_EQ(image.size(), cv::Size(128, 48));
  EXPECT_NEAR(levelOf(image.colRange(64, 128)) - levelOf(image.colRange(0, 64)), 100, 1);
}

/// Two streams that are decoded at different times still have the times at which they came.
TEST(VideoStream, SaysWhenAnImageCameNotWhenItWasDecoded) {
  ImageServer server("127.0.0.1", 0);
  cv::Mat noise(720, 1280, CV_8UC3), image;
  cv::randu(noise, 0, 255);
  std::atomic<bool> quit = false;
  std::thread serving([&] {
    while (!quit) {
      server.publish(noise, noise);
      std::this_thread::sleep_for(50ms);
    }
  });
  {
    VideoStream stream("http://127.0.0.1:" + std::to_string(server.port()) + "/left", {});
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(stream.read(image));
      EXPECT_EQ(image.size(), noise.size());
      EXPECT_GT(std::chrono::steady_clock::now() - stream.arrival(), 1ms)
          << "no computer decodes a million pixels of noise in less";
    }
  }
  quit = true;
  serving.join();
}

TEST_F(Served, ManyClientsThatComeAndGoDisturbNobody) {
  VideoStream left(at("/left"), {});
  for (int k = 0; k < 20; ++k) VideoStream(at(k % 2 ? "/right" : "/both"), {});
  cv::Mat image;
  EXPECT_TRUE(left.read(image));
}

TEST_F(Served, AnotherPathIsRefused) { EXPECT_THROW(VideoStream(at("/elsewhere"), {}), base::InputError); }

TEST_F(Served, APortInUseIsRefusedWithItsAddress) {
  try {
    ImageServer second("127.0.0.1", server_.port());
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(server_.port())), std::string::npos)
        << error.what();
  }
}

TEST(ImageServer, EndsWhileAClientWaits) {
  auto server = std::make_unique<ImageServer>("127.0.0.1", 0);
  server->publish(imageOf(0, 0), imageOf(0, 100));
  const std::string at = "http://127.0.0.1:" + std::to_string(server->port()) + "/left";
  auto reading = std::async(std::launch::async, [&] {
    try {
      VideoStream stream(at, {});
      cv::Mat image;
      while (stream.read(image)) {
      }
    } catch (const base::InputError&) {  // a single image may be too little to open a stream with
    }
    return true;
  });
  std::this_thread::sleep_for(100ms);
  server.reset();
  EXPECT_EQ(reading.wait_for(5s), std::future_status::ready);
}

}  // namespace
}  // namespace capstan::live
