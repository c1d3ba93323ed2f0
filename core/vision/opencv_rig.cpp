#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/base/part_file.h"
#include "core/base/yaml.h"
#include "core/vision/opencv_storage.h"
#include "core/vision/rig_file.h"

namespace capstan::vision {
namespace {

constexpr int kMostNumbers = 64;        ///< of a matrix; D has at most 14
constexpr double kLargestNumber = 1e9;  ///< of a matrix [px], [m]

/// An OpenCV file. All functions throw base::InputError with the file's name.
class OpenCvFile {
 public:
  explicit OpenCvFile(const std::filesystem::path& path)
      : name_(path.string()), root_(parseOpenCvStorage(base::readYamlTextFile(path), name_)) {
    if (!root_.IsMap()) refuse({}, {}, "cannot be read as an OpenCV file", "Give " + rigFileKinds());
  }

  const std::string& name() const { return name_; }
  [[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& reason,
                           const std::string& remedy) const {
    const YAML::Node node = key.empty() ? root_ : root_[key];
    throw base::InputError(
        {name_, node.IsDefined() ? std::max(0, node.Mark().line + 1) : 0, key, value, reason, remedy});
  }

  /// A matrix of numbers in one channel.
  cv::Mat_<double> matrix(const std::string& key) const {
    const YAML::Node node = root_[key];
    if (!node.IsDefined() || !node.IsMap() || !node["data"].IsDefined() || !node["data"].IsSequence())
      refuse(key, {}, "is missing or no matrix", "Give " + rigFileKinds());
    const YAML::Node data = node["data"];
    const int rows = count(node["rows"]), columns = count(node["cols"]);
    if (rows < 1 || columns < 1 || static_cast<std::size_t>(rows * columns) != data.size())
      refuse(key, fmt::format("{} x {}", rows, columns), fmt::format("has {} numbers", data.size()),
             "Write it as a cv::Mat of doubles in one channel, with at most 64 numbers");
    cv::Mat_<double> numbers(rows, columns);
    for (int i = 0; i < rows * columns; ++i) {
      const double value = numberOf(data[static_cast<std::size_t>(i)]);
      if (!(std::abs(value) <= kLargestNumber))
        refuse(key, {}, "has a number that is not finite", "Calibrate again");
      numbers(i / columns, i % columns) = value;
    }
    return numbers;
  }
  cv::Mat_<double> matrix(const std::string& key, int rows, int columns) const {
    cv::Mat_<double> read = matrix(key);
    if (columns == 1 && read.rows == 1 && read.cols == rows) read = read.t();
    if (read.rows != rows || read.cols != columns)
      refuse(key, fmt::format("{} x {}", read.rows, read.cols),
             fmt::format("is no {} x {} matrix", rows, columns), "Write the result of cv::stereoCalibrate");
    return read;
  }
  int size(const std::string& key) const {
    const double value = numberOf(root_[key]);
    if (!(value >= 1.0 && value <= 65536.0))
      refuse(key, {}, "is missing or no size of an image",
             "Add image_width and image_height [px]: OpenCV's sample does not write them");
    return static_cast<int>(value);
  }

 private:
  /// The number of a node; NaN: it is none.
  static double numberOf(const YAML::Node& node) {
    double value = base::kNaN;
    if (!node.IsDefined() || !node.IsScalar() || !YAML::convert<double>::decode(node, value))
      return base::kNaN;
    return value;
  }
  /// Number of rows or columns; 0: none that a matrix of a calibration has.
  static int count(const YAML::Node& node) {
    const double value = numberOf(node);
    return value >= 1.0 && value <= kMostNumbers && value == std::floor(value) ? static_cast<int>(value) : 0;
  }

  std::string name_;
  YAML::Node root_;
};

Camera cameraOf(const OpenCvFile& file, const std::string& number) {
  Camera camera;
  camera.name = "camera " + number;
  camera.width = file.size("image_width");
  camera.height = file.size("image_height");
  const cv::Mat_<double> k = file.matrix("M" + number, 3, 3);
  camera.fx = k(0, 0), camera.fy = k(1, 1), camera.cx = k(0, 2), camera.cy = k(1, 2);
  if (!(camera.fx > 0.0 && camera.fy > 0.0) || k(0, 1) != 0.0 || k(2, 2) != 1.0)
    file.refuse("M" + number, {}, "is not of the form [fx 0 cx; 0 fy cy; 0 0 1]", "Calibrate without skew");
  cv::Mat_<double> d = file.matrix("D" + number);
  d = d.reshape(1, 1);
  if (d.cols < 4)
    file.refuse("D" + number, fmt::format("{}", d.cols), "has fewer than 4 coefficients", "Calibrate again");
  for (int i = 0; i < d.cols; ++i) {
    if (i < 5) camera.distortion[static_cast<std::size_t>(i)] = d(0, i);
    if (i >= 5 && d(0, i) != 0.0)
      file.refuse("D" + number, fmt::format("{}", d(0, i)),
                  fmt::format("has a coefficient {} that is not zero: five are supported", i + 1),
                  "Calibrate without CALIB_RATIONAL_MODEL, CALIB_THIN_PRISM_MODEL and CALIB_TILTED_MODEL");
  }
  return camera;
}

void write(cv::FileStorage& storage, const Camera& camera, const std::string& number) {
  const cv::Mat_<double> k =
      (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Mat_<double> d(1, 5);
  std::copy(camera.distortion.begin(), camera.distortion.end(), d.begin());
  storage << "M" + number << k << "D" + number << d;
}

}  // namespace

StereoRig readOpenCvRig(const std::filesystem::path& path, const std::filesystem::path& extrinsics) {
  const OpenCvFile inner(path), outer(extrinsics.empty() ? path : extrinsics);
  const Camera first = cameraOf(inner, "1"), second = cameraOf(inner, "2");
  const cv::Mat_<double> r = outer.matrix("R", 3, 3), t = outer.matrix("T", 3, 1);
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation(i, j) = r(i, j);
  return sideBySide(first, second, rotation, {t(0, 0), t(1, 0), t(2, 0)}, outer.name(), "T");
}

void writeOpenCvRig(const StereoRig& rig, const std::filesystem::path& path) {
  base::PartFile part(path, base::PartFile::Keep::kSuffix);
  try {
    cv::FileStorage storage(part.path().string(), cv::FileStorage::WRITE);
    if (!storage.isOpened()) throw cv::Exception();
    storage << "image_width" << rig.left.width << "image_height" << rig.left.height;
    write(storage, rig.left, "1");
    write(storage, rig.right, "2");
    cv::Mat_<double> r(3, 3), t(3, 1);
    for (int i = 0; i < 3; ++i) {
      t(i, 0) = rig.right_from_left.translation()(i);
      for (int j = 0; j < 3; ++j) r(i, j) = rig.right_from_left.linear()(i, j);
    }
    storage << "R" << r << "T" << t;
  } catch (const cv::Exception&) {
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            "cannot be written",
                            "End its name in .yml, .xml or .json, and check the folder and the space"});
  }
  part.commit();
}

}  // namespace capstan::vision
