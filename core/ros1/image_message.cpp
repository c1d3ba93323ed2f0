#include "core/ros1/image_message.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/ros1/compressed_size.h"

namespace capstan::ros1 {
namespace {

/// Number of channels of an encoding, and OpenCV's conversion to BGR; −1: none is needed. ROS names a Bayer
/// pattern by the pixels of its first row, OpenCV by the second row's second and third.
struct Encoding {
  int channels, conversion;
};
const std::map<std::string, Encoding, std::less<>> kEncodings = {{"bgr8", {3, -1}},
                                                                 {"8UC3", {3, -1}},
                                                                 {"rgb8", {3, cv::COLOR_RGB2BGR}},
                                                                 {"bgra8", {4, cv::COLOR_BGRA2BGR}},
                                                                 {"rgba8", {4, cv::COLOR_RGBA2BGR}},
                                                                 {"mono8", {1, cv::COLOR_GRAY2BGR}},
                                                                 {"8UC1", {1, cv::COLOR_GRAY2BGR}},
                                                                 {"bayer_rggb8", {1, cv::COLOR_BayerBG2BGR}},
                                                                 {"bayer_bggr8", {1, cv::COLOR_BayerRG2BGR}},
                                                                 {"bayer_gbrg8", {1, cv::COLOR_BayerGR2BGR}},
                                                                 {"bayer_grbg8", {1, cv::COLOR_BayerGB2BGR}}};

template <class Numbers>
std::string listText(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + base::yamlText(number);
  return "[" + text + "]";
}

std::string matrixText(const char* key, int rows, int cols, const std::string& data) {
  return fmt::format("{}:\n  rows: {}\n  cols: {}\n  data: {}\n", key, rows, cols, data);
}

CameraInfo infoOf(const std::string& text) {
  const YAML::Node node = YAML::Load(text);
  CameraInfo info;
  info.width = node["image_width"].as<std::uint32_t>();
  info.height = node["image_height"].as<std::uint32_t>();
  info.header.frame = node["camera_name"].as<std::string>();
  info.distortion_model = node["distortion_model"].as<std::string>();
  info.d = node["distortion_coefficients"]["data"].as<std::vector<double>>();
  info.k = node["camera_matrix"]["data"].as<std::array<double, 9>>();
  info.r = node["rectification_matrix"]["data"].as<std::array<double, 9>>();
  info.p = node["projection_matrix"]["data"].as<std::array<double, 12>>();
  return info;
}

}  // namespace

cv::Mat imageOf(const Image& message) {
  const auto encoding = kEncodings.find(message.encoding);
  if (encoding == kEncodings.end())
    throw base::InputError({{},
                            0,
                            "encoding",
                            message.encoding,
                            "is not supported",
                            "Publish bgr8, rgb8, mono8 or an 8-bit Bayer pattern"});
  const auto row =
      static_cast<std::uint64_t>(message.width) * static_cast<std::uint64_t>(encoding->second.channels);
  if (!isImageSize(message.width, message.height) || message.step < row ||
      static_cast<std::uint64_t>(message.step) * message.height > message.data.size())
    throw base::InputError({{},
                            0,
                            "data",
                            fmt::format("{} bytes", message.data.size()),
                            fmt::format("do not hold {} x {} pixels of {} with a step of {} bytes",
                                        message.width, message.height, message.encoding, message.step),
                            "Check the program that publishes the images"});
  const cv::Mat given(static_cast<int>(message.height), static_cast<int>(message.width),
                      CV_8UC(encoding->second.channels), const_cast<std::uint8_t*>(message.data.data()),
                      message.step);
  if (encoding->second.conversion < 0) return given.clone();
  cv::Mat image;
  cv::cvtColor(given, image, encoding->second.conversion);
  return image;
}

cv::Mat imageOf(const CompressedImage& message) {
  cv::Mat image;
  const auto size = compressedSizeOf(message.data);
  if (size && !isImageSize(size->width, size->height))
    throw base::InputError({{},
                            0,
                            "data",
                            fmt::format("{} x {} pixels", size->width, size->height),
                            "are too many for an image",
                            "Check the program that publishes the images"});
  if (size) image = cv::imdecode(message.data, cv::IMREAD_COLOR);
  if (image.empty())
    throw base::InputError({{},
                            0,
                            "data",
                            fmt::format("{} bytes, format {}", message.data.size(), message.format),
                            "are no image",
                            "Publish JPEG or PNG images (image_transport's plugin compressed)"});
  return image;
}

Image messageOf(const cv::Mat& image, MessageHeader header) {
  Image message;
  message.header = std::move(header);
  message.width = static_cast<std::uint32_t>(image.cols),
  message.height = static_cast<std::uint32_t>(image.rows);
  message.encoding = image.channels() == 1 ? "mono8" : "bgr8";
  const std::size_t row = static_cast<std::size_t>(image.cols) * image.elemSize();
  message.step = static_cast<std::uint32_t>(row);
  message.data.resize(row * message.height);
  for (int y = 0; y < image.rows; ++y)
    std::copy_n(image.ptr(y), row, message.data.begin() + static_cast<std::ptrdiff_t>(row) * y);
  return message;
}

std::string calibrationTextOf(const CameraInfo& message) {
  std::vector<double> d = message.d;
  d.resize(std::max<std::size_t>(d.size(), 5));
  return fmt::format("image_width: {}\nimage_height: {}\ncamera_name: \"{}\"\n", message.width,
                     message.height, message.header.frame) +
         matrixText("camera_matrix", 3, 3, listText(message.k)) +
         fmt::format("distortion_model: {}\n",
                     message.distortion_model.empty() ? "plumb_bob" : message.distortion_model) +
         matrixText("distortion_coefficients", 1, static_cast<int>(d.size()), listText(d)) +
         matrixText("rectification_matrix", 3, 3, listText(message.r)) +
         matrixText("projection_matrix", 3, 4, listText(message.p));
}

std::array<CameraInfo, 2> messagesOf(const vision::StereoRig& rig) {
  const std::array<std::string, 2> texts = vision::formatStereoRig(rig);
  return {infoOf(texts[0]), infoOf(texts[1])};
}

}  // namespace capstan::ros1
