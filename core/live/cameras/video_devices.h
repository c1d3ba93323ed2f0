#pragma once

#include <functional>
#include <string>
#include <vector>

namespace capstan::live {

/// Images that a device offers.
struct VideoFormat {
  std::string pixels;         ///< four characters, such as "MJPG" or "YUYV"
  int width = 0, height = 0;  ///< [px]
  std::vector<double> rates;  ///< [1/s], falling
};

/// Setting of a device, in its own units.
struct VideoControl {
  std::string name;
  long least = 0, most = 0, now = 0;
};

/// Camera that Video4Linux2 knows.
struct VideoDevice {
  std::string path;  ///< "/dev/video0"
  std::string name;  ///< as the device calls itself
  std::string at;    ///< where it is plugged in: two cameras of one name differ in it
  std::vector<VideoFormat> formats;
  std::vector<VideoControl> controls;  ///< exposure, gain, white balance, focus, where the device has them
  std::string fault;                   ///< why it cannot be asked, such as missing permission; empty: it was
};

/// The system's calls, replaced in tests.
struct VideoSystem {
  std::function<int(const std::string& path)> open;  ///< negative: errno is set
  std::function<int(int file, unsigned long request, void* argument)> control;
  std::function<void(int file)> close;

  static VideoSystem real();
};

/// Devices of `folder` that capture images, in the order of their numbers. Devices that only give metadata
/// are not listed.
std::vector<VideoDevice> listVideoDevices(const std::string& folder = "/dev",
                                          const VideoSystem& system = VideoSystem::real());

}  // namespace capstan::live
