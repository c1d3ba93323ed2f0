#include "core/vision/rig_file.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <fstream>
#include <vector>

#include "core/base/error.h"

namespace capstan::vision {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestBaseline = 2.0;  ///< [m]; a larger number is in another unit
constexpr double kOrthogonal = 1e-3;

[[noreturn]] void refuse(const std::string& file, const std::string& key, const std::string& value,
                         const std::string& reason, const std::string& remedy) {
  throw base::InputError({file, 0, key, value, reason, remedy});
}

/// Path of `name` in the folder with the suffix .yml, .xml or .yaml; empty: none is there.
fs::path besides(const fs::path& folder, const std::string& name) {
  for (const char* suffix : {".yml", ".xml", ".yaml"})
    if (fs::exists(folder / (name + suffix))) return folder / (name + suffix);
  return {};
}

/// The only Kalibr camera chain in the folder; empty: none or several are there.
fs::path chainIn(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.find("camchain") != std::string::npos && name.ends_with(".yaml")) found.push_back(entry.path());
  }
  return found.size() == 1 ? found.front() : fs::path();
}

StereoRig readFolder(const fs::path& folder) {
  if (!fs::exists(folder / "left.yaml")) {
    if (const fs::path chain = chainIn(folder); !chain.empty()) return readKalibr(chain);
    const fs::path intrinsics = besides(folder, "intrinsics"), extrinsics = besides(folder, "extrinsics");
    if (!intrinsics.empty() && !extrinsics.empty()) return readOpenCvRig(intrinsics, extrinsics);
  }
  return readStereoRig(folder / "left.yaml", folder / "right.yaml");
}

bool isOpenCv(const fs::path& path) {
  const std::string suffix = path.extension().string();
  if (suffix == ".xml" || suffix == ".json") return true;
  std::ifstream in(path, std::ios::binary);
  std::string first(5, '\0');
  in.read(first.data(), 5);
  return first == "%YAML";  // Kalibr and ROS write none
}

}  // namespace

std::string rigFileKinds() {
  return "a folder with left.yaml and right.yaml (ROS camera_info), a Kalibr camchain.yaml, or an OpenCV "
         "file with M1, D1, M2, D2, R, T";
}

StereoRig readRig(const fs::path& path) {
  std::error_code fault;
  if (fs::is_directory(path, fault)) return readFolder(path);
  if (!fs::exists(path, fault)) refuse(path.string(), {}, {}, "does not exist", "Give " + rigFileKinds());
  if (path.filename() == "left.yaml" || path.filename() == "right.yaml")
    return readFolder(path.parent_path());
  return isOpenCv(path) ? readOpenCvRig(path) : readKalibr(path);
}

StereoRig sideBySide(const Camera& first, const Camera& second, const Eigen::Matrix3d& rotation,
                     const Eigen::Vector3d& translation, const std::string& file, const std::string& key) {
  if (first.width != second.width || first.height != second.height)
    refuse(file, "size of the images",
           fmt::format("{} x {} and {} x {}", first.width, first.height, second.width, second.height),
           "differs between the cameras", "Set both cameras to one size and calibrate them together");
  const Eigen::Matrix3d excess = rotation * rotation.transpose() - Eigen::Matrix3d::Identity();
  if (!(excess.array().abs() <= kOrthogonal).all() || !(rotation.determinant() > 0.0))
    refuse(file, key, {}, "has no rotation", "Calibrate both cameras together");
  const double baseline = translation.norm();
  if (!(baseline > 0.0 && baseline < kLargestBaseline))
    refuse(file, key, fmt::format("{:.6g}", baseline),
           fmt::format("has a baseline that is not between 0 and {} m", kLargestBaseline),
           "Give the size of the target's squares in metres when calibrating");
  if (std::abs(translation.y()) > std::abs(translation.x()))
    refuse(file, key, {}, "describes cameras one above the other", "Place the cameras side by side");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d second_from_first = Eigen::Isometry3d::Identity();
  second_from_first.linear() = svd.matrixU() * svd.matrixV().transpose();
  second_from_first.translation() = translation;
  if (translation.x() < 0.0) return {first, second, second_from_first};
  return {second, first, second_from_first.inverse()};
}

}  // namespace capstan::vision
