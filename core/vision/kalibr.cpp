#include <algorithm>
#include <array>

#include "core/base/yaml.h"
#include "core/vision/rig_file.h"

namespace capstan::vision {
namespace {

constexpr const char* kCalibrate = "Calibrate with --models pinhole-radtan pinhole-radtan";

class CameraReader {
 public:
  CameraReader(const YAML::Node& chain, std::string file, std::string name)
      : node_(chain[name]), file_(std::move(file)), name_(std::move(name)) {
    if (!node_.IsDefined() || !node_.IsMap())
      base::refuseYaml(chain, {file_, name_}, "is missing",
                       "A camera chain has cam0 and cam1; other kinds of files: give " + rigFileKinds());
  }

  Camera read() const {
    checkName("camera_model", "pinhole");
    Camera camera;
    camera.name = name_;
    const auto intrinsics = value<Eigen::Vector4d>("intrinsics");
    camera.fx = intrinsics(0), camera.fy = intrinsics(1), camera.cx = intrinsics(2),
    camera.cy = intrinsics(3);
    if (!(camera.fx > 0.0 && camera.fy > 0.0))
      base::refuseYaml(child("intrinsics"), at("intrinsics"), "has a focal length that is not positive",
                       "Calibrate the camera again");
    const auto resolution = value<std::array<int, 2>>("resolution", {1.0, 65536.0});
    camera.width = resolution[0], camera.height = resolution[1];
    if (child("distortion_model").Scalar() == "none") return camera;
    checkName("distortion_model", "radtan");
    const auto coefficients = value<std::array<double, 4>>("distortion_coeffs");
    std::copy(coefficients.begin(), coefficients.end(), camera.distortion.begin());
    return camera;
  }

  /// Points of the camera before, in the frame of this one.
  Eigen::Matrix4d fromPrevious() const { return value<Eigen::Matrix4d>("T_cn_cnm1"); }

 private:
  base::YamlPlace at(const std::string& key) const { return {file_, name_ + "." + key}; }
  YAML::Node child(const std::string& key) const {
    const YAML::Node found = node_[key];
    if (!found.IsDefined() || found.IsNull())
      base::refuseYaml(node_, at(key), "is missing", "Give the file that kalibr_calibrate_cameras wrote");
    return found;
  }
  template <class T>
  T value(const std::string& key, const base::Range& range = {-1e9, 1e9}) const {
    T read{};
    base::detail::readInto(read, child(key), at(key), {key.c_str(), "", "", range});
    return read;
  }
  void checkName(const std::string& key, const std::string& known) const {
    if (child(key).Scalar() != known)
      base::refuseYaml(child(key), at(key), "is not " + known + ", the only supported model", kCalibrate);
  }

  YAML::Node node_;
  std::string file_, name_;
};

}  // namespace

StereoRig readKalibr(const std::filesystem::path& path) {
  const std::string file = path.string();
  const YAML::Node chain = base::parseYamlText(base::readYamlTextFile(path), file);
  if (!chain.IsMap() || !chain["cam0"].IsDefined())
    base::refuseYaml(chain, {file, "cam0"}, "is missing: this is no camera chain of Kalibr",
                     "Give " + rigFileKinds());
  const CameraReader first(chain, file, "cam0"), second(chain, file, "cam1");
  const Eigen::Matrix4d transform = second.fromPrevious();
  return sideBySide(first.read(), second.read(), transform.topLeftCorner<3, 3>(),
                    transform.topRightCorner<3, 1>(), file, "cam1.T_cn_cnm1");
}

}  // namespace capstan::vision
