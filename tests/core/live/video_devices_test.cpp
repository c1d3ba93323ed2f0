/// A camera as the kernel's documentation of Video4Linux2 describes it, in place of a real one.
#include "core/live/cameras/video_devices.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

namespace capstan::live {
namespace {

namespace fs = std::filesystem;

/// Two devices: video2 captures MJPG at 640×480 (30, 15 frames/s) and YUYV in any size; video10 is its
/// metadata. video3 may not be opened.
class Kernel {
 public:
  VideoSystem system() {
    return {
        [this](const std::string& path) { return open(path); },
        [this](int file, unsigned long request, void* argument) { return control(file, request, argument); },
        [this](int file) { open_.erase(file); }};
  }
  std::size_t openFiles() const { return open_.size(); }

 private:
  int open(const std::string& path) {
    if (path.ends_with("video3")) {
      errno = EACCES;
      return -1;
    }
    const int file = 3 + opened_++;
    open_[file] = path.ends_with("video10");
    return file;
  }

  int control(int file, unsigned long request, void* argument) {
    const auto none = [] {
      errno = EINVAL;
      return -1;
    };
    switch (request) {
      case VIDIOC_QUERYCAP: {
        auto& capability = *static_cast<v4l2_capability*>(argument);
        std::strcpy(reinterpret_cast<char*>(capability.card), "Endoscope");
        std::strcpy(reinterpret_cast<char*>(capability.bus_info), "usb-0000:00:14.0-2");
        capability.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE;
        capability.device_caps = open_.at(file) ? V4L2_CAP_META_CAPTURE : V4L2_CAP_VIDEO_CAPTURE;
        return 0;
      }
      case VIDIOC_ENUM_FMT: {
        auto& format = *static_cast<v4l2_fmtdesc*>(argument);
        if (format.index > 1) return none();
        format.pixelformat = format.index == 0 ? V4L2_PIX_FMT_MJPEG : V4L2_PIX_FMT_YUYV;
        return 0;
      }
      case VIDIOC_ENUM_FRAMESIZES: {
        auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
        if (size.index > 0) return none();
        if (size.pixel_format == V4L2_PIX_FMT_MJPEG) {
          size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
          size.discrete = {640, 480};
        } else {
          size.type = V4L2_FRMSIZE_TYPE_STEPWISE;
          size.stepwise = {16, 1280, 16, 16, 720, 16};
        }
        return 0;
      }
      case VIDIOC_ENUM_FRAMEINTERVALS: {
        auto& interval = *static_cast<v4l2_frmivalenum*>(argument);
        if (interval.index > 1) return none();
        interval.type = V4L2_FRMIVAL_TYPE_DISCRETE;
        interval.discrete = {1, interval.index == 0 ? 15U : 30U};
        return 0;
      }
      case VIDIOC_QUERYCTRL: {
        auto& query = *static_cast<v4l2_queryctrl*>(argument);
        if (query.id != V4L2_CID_GAIN) return none();
        std::strcpy(reinterpret_cast<char*>(query.name), "Gain");
        query.minimum = 0, query.maximum = 255;
        return 0;
      }
      case VIDIOC_G_CTRL:
        static_cast<v4l2_control*>(argument)->value = 64;
        return 0;
      default:
        return none();
    }
  }

  int opened_ = 0;
  std::map<int, bool> open_;  ///< true: metadata only
};

TEST(VideoDevices, AreListedWithWhatTheyOffer) {
  const fs::path folder = fs::temp_directory_path() / ("capstan_devices_" + std::to_string(getpid()));
  fs::create_directory(folder);
  for (const char* name : {"video10", "video2", "video3", "video", "videoX", "null"})
    std::ofstream(folder / name);
  Kernel kernel;
  const std::vector<VideoDevice> devices = listVideoDevices(folder.string(), kernel.system());
  fs::remove_all(folder);
  EXPECT_EQ(kernel.openFiles(), 0U);
  ASSERT_EQ(devices.size(), 2U) << "video10 gives metadata only";
  const VideoDevice& camera = devices[0];
  EXPECT_EQ(camera.path, (folder / "video2").string());
  EXPECT_EQ(camera.name, "Endoscope");
  EXPECT_EQ(camera.at, "usb-0000:00:14.0-2");
  EXPECT_TRUE(camera.fault.empty());
  ASSERT_EQ(camera.formats.size(), 5U) << "one of MJPG, four usual sizes up to 1280×720 of YUYV";
  EXPECT_EQ(camera.formats[0].pixels, "MJPG");
  EXPECT_EQ(camera.formats[0].width, 640);
  EXPECT_EQ(camera.formats[0].rates, (std::vector{30.0, 15.0}));
  EXPECT_EQ(camera.formats.back().pixels, "YUYV");
  EXPECT_EQ(camera.formats.back().height, 720);
  ASSERT_EQ(camera.controls.size(), 1U);
  EXPECT_EQ(camera.controls[0].name, "Gain");
  EXPECT_EQ(camera.controls[0].most, 255);
  EXPECT_EQ(camera.controls[0].now, 64);
  EXPECT_EQ(devices[1].fault, std::strerror(EACCES));
}

TEST(VideoDevices, OfAFolderThatIsMissingAreNone) { EXPECT_TRUE(listVideoDevices("/nowhere").empty()); }

}  // namespace
}  // namespace capstan::live
