#include "core/live/cameras/video_devices.h"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>

namespace capstan::live {
namespace {

/// Sizes and rates of a device with a continuous range, of which the usual ones are listed.
constexpr std::array<std::array<int, 2>, 6> kUsualSizes = {
    {{320, 240}, {640, 480}, {800, 600}, {1280, 720}, {1280, 960}, {1920, 1080}}};
/// A driver that never ends an enumeration is asked no further.
constexpr unsigned kMost = 256;

constexpr std::array<unsigned, 4> kControls = {V4L2_CID_EXPOSURE_ABSOLUTE, V4L2_CID_GAIN,
                                               V4L2_CID_WHITE_BALANCE_TEMPERATURE, V4L2_CID_FOCUS_ABSOLUTE};

/// An open device.
class Device {
 public:
  Device(const VideoSystem& system, const std::string& path) : system_(system), file_(system.open(path)) {}
  ~Device() {
    if (file_ >= 0) system_.close(file_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  bool isOpen() const { return file_ >= 0; }
  template <class Argument>
  bool ask(unsigned long request, Argument& argument) const {
    return system_.control(file_, request, &argument) == 0;
  }

 private:
  const VideoSystem& system_;
  const int file_;
};

template <std::size_t N>
std::string textOf(const __u8 (&characters)[N]) {
  const char* text = reinterpret_cast<const char*>(characters);
  return {text, strnlen(text, N)};
}

std::string fourCharacters(unsigned code) {
  std::string text;
  for (int k = 0; k < 4; ++k) text += static_cast<char>((code >> (8 * k)) & 0x7f);
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

std::vector<double> ratesOf(const Device& device, unsigned pixels, int width, int height) {
  std::vector<double> rates;
  const auto add = [&](const v4l2_fract& period) {
    if (period.numerator > 0) rates.push_back(static_cast<double>(period.denominator) / period.numerator);
  };
  for (unsigned k = 0; k < kMost; ++k) {
    v4l2_frmivalenum interval{};
    interval.index = k, interval.pixel_format = pixels;
    interval.width = static_cast<unsigned>(width), interval.height = static_cast<unsigned>(height);
    if (!device.ask(VIDIOC_ENUM_FRAMEINTERVALS, interval)) break;
    if (interval.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      add(interval.discrete);
      continue;
    }
    add(interval.stepwise.min);
    add(interval.stepwise.max);
    break;
  }
  std::ranges::sort(rates, std::greater());
  return rates;
}

std::vector<std::array<int, 2>> sizesOf(const Device& device, unsigned pixels) {
  std::vector<std::array<int, 2>> sizes;
  for (unsigned k = 0; k < kMost; ++k) {
    v4l2_frmsizeenum size{};
    size.index = k, size.pixel_format = pixels;
    if (!device.ask(VIDIOC_ENUM_FRAMESIZES, size)) break;
    if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
      sizes.push_back({static_cast<int>(size.discrete.width), static_cast<int>(size.discrete.height)});
      continue;
    }
    const auto fits = [&](const std::array<int, 2>& usual) {
      return usual[0] >= static_cast<int>(size.stepwise.min_width) &&
             usual[0] <= static_cast<int>(size.stepwise.max_width) &&
             usual[1] >= static_cast<int>(size.stepwise.min_height) &&
             usual[1] <= static_cast<int>(size.stepwise.max_height);
    };
    std::ranges::copy_if(kUsualSizes, std::back_inserter(sizes), fits);
    break;
  }
  return sizes;
}

std::vector<VideoFormat> formatsOf(const Device& device) {
  std::vector<VideoFormat> formats;
  for (unsigned k = 0; k < kMost; ++k) {
    v4l2_fmtdesc description{};
    description.index = k, description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (!device.ask(VIDIOC_ENUM_FMT, description)) break;
    for (const auto& [width, height] : sizesOf(device, description.pixelformat))
      formats.push_back({fourCharacters(description.pixelformat), width, height,
                         ratesOf(device, description.pixelformat, width, height)});
  }
  return formats;
}

std::vector<VideoControl> controlsOf(const Device& device) {
  std::vector<VideoControl> controls;
  for (const unsigned id : kControls) {
    v4l2_queryctrl query{};
    query.id = id;
    if (!device.ask(VIDIOC_QUERYCTRL, query) || (query.flags & V4L2_CTRL_FLAG_DISABLED)) continue;
    v4l2_control value{};
    value.id = id;
    if (!device.ask(VIDIOC_G_CTRL, value)) continue;
    controls.push_back({textOf(query.name), query.minimum, query.maximum, value.value});
  }
  return controls;
}

/// Nothing for a device that captures no images.
std::optional<VideoDevice> deviceOf(const std::string& path, const VideoSystem& system) {
  VideoDevice found;
  found.path = path;
  const Device device(system, path);
  v4l2_capability capability{};
  if (!device.isOpen() || !device.ask(VIDIOC_QUERYCAP, capability)) {
    found.fault = std::strerror(errno);
    return found;
  }
  const unsigned able =
      capability.capabilities & V4L2_CAP_DEVICE_CAPS ? capability.device_caps : capability.capabilities;
  if (!(able & V4L2_CAP_VIDEO_CAPTURE)) return {};
  found.name = textOf(capability.card), found.at = textOf(capability.bus_info);
  found.formats = formatsOf(device), found.controls = controlsOf(device);
  return found;
}

/// Number of "video7"; nothing for other names.
std::optional<int> numberOf(const std::string& name) {
  constexpr std::string_view kVideo = "video";
  int number = 0;
  if (!name.starts_with(kVideo) || name.size() == kVideo.size()) return {};
  const char* end = name.data() + name.size();
  const auto [last, fault] = std::from_chars(name.data() + kVideo.size(), end, number);
  if (fault != std::errc() || last != end) return {};
  return number;
}

}  // namespace

VideoSystem VideoSystem::real() {
  return {[](const std::string& path) { return ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); },
          [](int file, unsigned long request, void* argument) { return ::ioctl(file, request, argument); },
          [](int file) { ::close(file); }};
}

std::vector<VideoDevice> listVideoDevices(const std::string& folder, const VideoSystem& system) {
  std::vector<std::pair<int, std::string>> paths;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (const auto number = numberOf(entry.path().filename().string()))
      paths.emplace_back(*number, entry.path().string());
  std::ranges::sort(paths);
  std::vector<VideoDevice> devices;
  for (const auto& [number, path] : paths)
    if (auto device = deviceOf(path, system)) devices.push_back(std::move(*device));
  return devices;
}

}  // namespace capstan::live
