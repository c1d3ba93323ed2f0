/// Answers of HTTP servers, as camera servers and others give them.
#include "core/live/cameras/http_images.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>

#include "core/base/error.h"
#include "core/live/cameras/http_url.h"
#include "core/live/cameras/image_server.h"
#include "core/live/cameras/video_stream.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;

std::string jpegOf(int level) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(level)), bytes);
  return {bytes.begin(), bytes.end()};
}

/// A server with one answer a path.
class HttpServer : public ::testing::Test {
 protected:
  HttpServer() {
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::yield();
  }
  ~HttpServer() override {
    server_.stop();
    thread_.join();
  }
  void answer(const std::string& path, const std::string& type, const std::string& body) {
    server_.Get(path, [=](const httplib::Request&, httplib::Response& response) {
      response.set_chunked_content_provider(type, [=](std::size_t, httplib::DataSink& sink) {
        sink.write(body.data(), body.size());
        sink.done();
        return true;
      });
    });
  }
  std::string at(const std::string& path) const { return "http://127.0.0.1:" + std::to_string(port_) + path; }
  std::string faultOf(const std::string& path) const {
    try {
      HttpImages::open(at(path), 2s);
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().file, at(path));
      return error.what();
    }
    return "";
  }

  httplib::Server server_;
  int port_ = 0;
  std::thread thread_;
};

TEST_F(HttpServer, MotionJpegIsRead) {
  const std::string body = "--b\r\nContent-Type: image/jpeg\r\nX-Timestamp: 5.25\r\n\r\n" + jpegOf(40) +
                           "\r\n--b\r\nContent-Type: image/jpeg\r\n\r\n" + jpegOf(80) + "\r\n--b--\r\n";
  answer("/images", "multipart/x-mixed-replace;boundary=b", body);
  answer("/ffmpeg", "application/octet-stream", body);  // its type says nothing
  for (const char* path : {"/images", "/ffmpeg"}) {
    const auto images = HttpImages::open(at(path), 2s).images;
    ASSERT_TRUE(images) << path;
    JpegPart part;
    ASSERT_TRUE(images->next(part, 1s));
    EXPECT_EQ(part.stamp, 5250000000);
    EXPECT_EQ(std::string(part.bytes.begin(), part.bytes.end()), jpegOf(40));
    ASSERT_TRUE(images->next(part, 1s));
    EXPECT_EQ(part.stamp, 0);
    EXPECT_FALSE(images->next(part, 1s)) << "the stream has ended";
    EXPECT_EQ(images->lost(), 0U);
  }
}

TEST_F(HttpServer, ADamagedImageIsPassedOverAndCounted) {
  std::string body;
  for (const std::string& image : {jpegOf(40), std::string("no image"), jpegOf(80)})
    body += "--b\r\nContent-Type: image/jpeg\r\n\r\n" + image + "\r\n";
  answer("/images", "multipart/x-mixed-replace;boundary=b", body + "--b--\r\n");
  VideoStream stream(at("/images"), {});
  cv::Mat image;
  ASSERT_TRUE(stream.read(image));
  EXPECT_EQ(stream.lost(), 0U);
  ASSERT_TRUE(stream.read(image));
  EXPECT_EQ(stream.lost(), 1U);
  EXPECT_NEAR(cv::mean(image)[0], 80, 1);
  EXPECT_FALSE(stream.read(image));
}

TEST_F(HttpServer, AReaderThatIsBehindLosesTheOldest) {
  constexpr int kImages = 40;
  std::string body;
  for (int k = 0; k < kImages; ++k)
    body += "--b\r\nX-Timestamp: " + std::to_string(k + 1) + "\r\n\r\n" + jpegOf(k) + "\r\n";
  answer("/images", "multipart/x-mixed-replace;boundary=b", body + "--b--\r\n");
  const auto images = HttpImages::open(at("/images"), 2s).images;
  ASSERT_TRUE(images);
  std::this_thread::sleep_for(300ms);
  JpegPart part;
  ASSERT_TRUE(images->next(part, 1s));
  EXPECT_EQ(images->lost(), kImages - HttpImages::kWaiting);
  EXPECT_EQ(part.stamp / 1000000000, kImages - static_cast<int>(HttpImages::kWaiting) + 1);
}

TEST_F(HttpServer, WhatIsNoMotionJpegIsLeftToFfmpeg) {
  answer("/page", "text/html", "<html></html>");
  answer("/video", "video/mp4", std::string(100000, 'v'));
  answer("/unknown", "application/octet-stream", std::string(100000, 'v'));
  server_.Get("/secret", [](const httplib::Request&, httplib::Response& response) { response.status = 401; });
  for (const auto& [path, words] : {std::pair{"/page", "the server sends text/html"},
                                    {"/video", "the server sends video/mp4"},
                                    {"/unknown", "the server sends application/octet-stream"},
                                    {"/secret", "USER:PASSWORD"}}) {
    const HttpImages::Opened opened = HttpImages::open(at(path), 2s);
    EXPECT_FALSE(opened.images) << path;
    EXPECT_NE(opened.other.find(words), std::string::npos) << opened.other;
    try {
      const VideoStream stream(at(path), {});
      ADD_FAILURE() << path << " was opened";
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST_F(HttpServer, APasswordThatIsRefusedIsNotAskedForAgain) {
  server_.Get("/secret", [](const httplib::Request&, httplib::Response& response) { response.status = 401; });
  const auto opened =
      HttpImages::open("http://user:wrong@127.0.0.1:" + std::to_string(port_) + "/secret", 2s);
  EXPECT_EQ(opened.other, "the server refuses this user name and password");
}

TEST(HttpUrl, MessagesHaveNoPassword) {
  EXPECT_EQ(withoutPassword("rtsp://lab:secret@camera:554/x@y?z"), "rtsp://camera:554/x@y?z");
  EXPECT_EQ(withoutPassword("http://lab:a@b@camera"), "http://camera");
  for (const char* same : {"http://camera/a@b", "/dev/video0", "left@lab.mkv", "ros:/left"})
    EXPECT_EQ(withoutPassword(same), same);
}

TEST(HttpUrl, PartsOfAnAddress) {
  const HttpUrl all = parseHttpUrl("http://lab%40site:a%3Ab%25@[::1]:8081/left?action=stream");
  EXPECT_EQ(all.user, "lab@site");
  EXPECT_EQ(all.password, "a:b%");
  EXPECT_EQ(all.host, "::1");
  EXPECT_EQ(all.port, 8081);
  EXPECT_EQ(all.path, "/left?action=stream");
  const HttpUrl least = parseHttpUrl("http://camera");
  EXPECT_EQ(least.host, "camera");
  EXPECT_EQ(least.port, 80);
  EXPECT_EQ(least.path, "/");
  EXPECT_EQ(parseHttpUrl("http://camera?x").path, "/?x");
  EXPECT_EQ(parseHttpUrl("http://u:100%@camera").password, "100%") << "not a character in %XX";
  EXPECT_EQ(parseHttpUrl("http://[::1]/").port, 80);
  for (const char* wrong : {"http://", "http://:80/", "http://camera:0/", "http://camera:65536/",
                            "http://camera:/", "http://camera:8o/", "http://[::1/", "http://[::1]8081/",
                            "http://[::1]x:80/", "http://lab:a/b@cam/x"})
    EXPECT_THROW(parseHttpUrl(wrong), base::InputError) << wrong;
}

TEST_F(HttpServer, WaitingForASilentServerCanBeCancelled) {
  std::atomic<bool> asked{false}, cancelled{false}, done{false};
  server_.Get("/silent", [&](const httplib::Request&, httplib::Response&) {
    asked = true;
    while (!done) std::this_thread::sleep_for(10ms);
  });
  std::thread user([&] {
    while (!asked) std::this_thread::sleep_for(10ms);
    cancelled = true;
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(VideoStream(at("/silent"), {}, &cancelled), base::InputError);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, VideoStream::kOpening / 2);
  done = true;
  user.join();
}

TEST_F(HttpServer, FaultsNameTheReason) {
  answer("/text", "multipart/x-mixed-replace;boundary=b", "--b\r\nContent-Type: text/plain\r\n\r\nhello\r\n");
  answer("/nothing", "multipart/x-mixed-replace;boundary=b", "--b\r\n");
  EXPECT_NE(faultOf("/text").find("text/plain"), std::string::npos);
  EXPECT_NE(faultOf("/nothing").find("no image"), std::string::npos);
  EXPECT_NE(faultOf("/elsewhere").find("404"), std::string::npos);
  EXPECT_THROW(HttpImages::open("http://127.0.0.1:0/", 2s), base::InputError);
  EXPECT_THROW(HttpImages::open("http://127.0.0.1:port/", 2s), base::InputError);
  server_.stop();
  EXPECT_NE(faultOf("/text").find("no server answers"), std::string::npos);
}

TEST_F(HttpServer, FollowsRedirectsAndSendsAPassword) {
  answer("/images", "multipart/x-mixed-replace;boundary=b", "--b\r\n\r\n" + jpegOf(3) + "\r\n--b--\r\n");
  server_.Get("/moved", [](const httplib::Request& request, httplib::Response& response) {
    if (request.get_header_value("Authorization") == "Basic dXNlcjpzZWNyZXQ=")
      response.set_redirect("/images?action=stream");
    else
      response.status = 403;
  });
  EXPECT_TRUE(
      HttpImages::open("http://user:secret@127.0.0.1:" + std::to_string(port_) + "/moved", 2s).images);
  EXPECT_NE(faultOf("/moved").find("403"), std::string::npos);
}

TEST(HttpImages, TheServersStampsComeThrough) {
  ImageServer server("127.0.0.1", 0);
  const cv::Mat image(48, 64, CV_8UC3, cv::Scalar::all(9));
  constexpr std::int64_t kBegin = 1700000000000001000, kPeriod = 33333000;
  std::atomic<bool> quit = false;
  std::thread serving([&] {
    for (int k = 0; !quit; ++k) {
      server.publish(image, image, kBegin + k * kPeriod);
      std::this_thread::sleep_for(20ms);
    }
  });
  const std::string at = "http://127.0.0.1:" + std::to_string(server.port());
  VideoStream left(at + "/left", {}), right(at + "/right", {});
  cv::Mat read;
  for (VideoStream* stream : {&left, &right})
    for (std::int64_t k = 0, last = 0; k < 5; ++k, last = stream->stamp()) {
      ASSERT_TRUE(stream->read(read));
      EXPECT_EQ((stream->stamp() - kBegin) % kPeriod, 0);
      EXPECT_GT(stream->stamp(), last);
    }
  quit = true;
  serving.join();
}

}  // namespace
}  // namespace capstan::live
