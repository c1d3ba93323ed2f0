#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "core/base/yaml.h"
#include "core/vision/camera.h"

namespace capstan::vision {

namespace {

template <int Rows, int Cols>
struct InfoMatrix {
  int rows = Rows, cols = Cols;
  Eigen::Matrix<double, Rows * Cols, 1> data = Eigen::Matrix<double, Rows * Cols, 1>::Zero();  ///< row by row

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rows, {"rows", "", "number of rows", {Rows, Rows}});
    field(self.cols, {"cols", "", "number of columns", {Cols, Cols}});
    field(self.data, {"data", "", "elements, row by row", {-1e9, 1e9}});
  }
  Eigen::Matrix<double, Rows, Cols> matrix() const {
    Eigen::Matrix<double, Rows, Cols> out;
    for (int i = 0; i < Rows; ++i)
      for (int j = 0; j < Cols; ++j) out(i, j) = data(i * Cols + j);
    return out;
  }
  void set(const Eigen::Matrix<double, Rows, Cols>& from) {
    for (int i = 0; i < Rows; ++i)
      for (int j = 0; j < Cols; ++j) data(i * Cols + j) = from(i, j);
  }
};

/// sensor_msgs/CameraInfo in the YAML format of camera_calibration_parsers.
struct CameraInfo {
  int width = 0, height = 0;
  std::string name, model = "plumb_bob";
  InfoMatrix<3, 3> camera, rectification;
  InfoMatrix<1, 5> distortion;
  InfoMatrix<3, 4> projection;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.width, {"image_width", "", "width of the image [px]", {1, 65536}});
    field(self.height, {"image_height", "", "height of the image [px]", {1, 65536}});
    field(self.name, {"camera_name", "", "name of the camera", {}, false});
    field(self.camera, {"camera_matrix", "", "3 x 3 intrinsic matrix [px]"});
    field(self.model, {"distortion_model", "", "plumb_bob", {}, false});
    field(self.distortion, {"distortion_coefficients", "", "k1, k2, p1, p2, k3"});
    field(self.rectification, {"rectification_matrix", "", "3 x 3 rotation into the rectified frame"});
    field(self.projection, {"projection_matrix", "", "3 x 4 projection of the rectified frame"});
  }
};

struct InfoFile {
  std::string name, text;
  CameraInfo info;

  /// Throws an InputError with the line of `key` in the text, for checks of several numbers at once.
  [[noreturn]] void refuse(const std::string& key, const std::string& reason,
                           const std::string& remedy) const {
    const YAML::Node node = base::parseYamlText(text, name)[key];
    base::refuseYaml(node.IsMap() ? node["data"] : node, {name, node.IsMap() ? key + ".data" : key}, reason,
                     remedy);
  }
};

void checkCamera(const InfoFile& file) {
  const CameraInfo& info = file.info;
  if (info.model != "plumb_bob")
    file.refuse(
        "distortion_model", "is not plumb_bob, the only supported model",
        "Calibrate with five coefficients (ROS camera_calibration: without --k-coefficients above 3)");
  const Eigen::Matrix3d k = info.camera.matrix();
  if (!(k(0, 0) > 0.0 && k(1, 1) > 0.0))
    file.refuse("camera_matrix", "has a focal length that is not positive",
                "Calibrate the camera; zeros mean that it never was");
  if (k(0, 1) != 0.0 || k(1, 0) != 0.0 || k(2, 0) != 0.0 || k(2, 1) != 0.0 || k(2, 2) != 1.0)
    file.refuse("camera_matrix", "is not of the form [fx 0 cx; 0 fy cy; 0 0 1]",
                "Write the matrix row by row, without skew");
  const Eigen::Matrix3d r = info.rectification.matrix();
  constexpr double kOrthogonal = 1e-3;
  const Eigen::Matrix3d excess = r * r.transpose() - Eigen::Matrix3d::Identity();
  if (!(excess.array().abs() <= kOrthogonal).all() || !(r.determinant() > 0.0))
    file.refuse("rectification_matrix", "is not a rotation",
                "Calibrate both cameras together, as a stereo pair");
  if (!(info.projection.data(0) > 0.0))
    file.refuse("projection_matrix", "has a focal length that is not positive",
                "Calibrate both cameras together, as a stereo pair");
}

InfoFile readInfo(const std::string& text, const std::string& name) {
  InfoFile file{name, text, base::readYaml<CameraInfo>(text, name)};
  checkCamera(file);
  return file;
}

Camera cameraOf(const CameraInfo& info) {
  Camera camera;
  camera.name = info.name;
  camera.width = info.width;
  camera.height = info.height;
  const Eigen::Matrix3d k = info.camera.matrix();
  camera.fx = k(0, 0);
  camera.fy = k(1, 1);
  camera.cx = k(0, 2);
  camera.cy = k(1, 2);
  for (int i = 0; i < 5; ++i) camera.distortion[static_cast<std::size_t>(i)] = info.distortion.data(i);
  return camera;
}

/// Nearest rotation to `m`, so that rounded numbers in a file do not become shear. Keeps exact rotations.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& matrix) {
  if ((matrix * matrix.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-14)
    return matrix;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

constexpr double kLargestBaseline = 100.0;  ///< [m]

StereoRig rigOf(const InfoFile& left, const InfoFile& right) {
  const Eigen::Matrix<double, 3, 4> p_left = left.info.projection.matrix(),
                                    p_right = right.info.projection.matrix();
  if (p_left(0, 3) != 0.0 || p_left(1, 3) != 0.0)
    left.refuse("projection_matrix", "has a baseline, which only the right camera's has",
                p_left(0, 3) < 0.0 ? "Exchange left and right: this is the right camera's"
                                   : "Calibrate both cameras together, as a stereo pair");
  if (p_right(1, 3) != 0.0)
    right.refuse("projection_matrix", "describes cameras one above the other",
                 "Place the cameras side by side");
  const double baseline = -p_right(0, 3) / p_right(0, 0);  // ROS: P(0, 3) = −fx' · baseline
  if (!(baseline > 0.0))
    right.refuse(
        "projection_matrix",
        baseline == 0.0 ? "has no baseline" : "puts this camera to the left of the other",
        baseline == 0.0 ? "Calibrate both cameras together, as a stereo pair" : "Exchange the two cameras");
  if (!(baseline < kLargestBaseline))
    right.refuse("projection_matrix", "has a baseline of more than 100 m",
                 "Calibrate both cameras together, in metres");
  if (left.info.width != right.info.width || left.info.height != right.info.height)
    right.refuse("image_width", "and image_height differ from the left camera's",
                 "Use the files of one calibration");

  // The rectified frames are parallel and shifted: R_right x_right = R_left x_left − (baseline, 0, 0).
  const Eigen::Matrix3d r_left = nearestRotation(left.info.rectification.matrix());
  const Eigen::Matrix3d r_right = nearestRotation(right.info.rectification.matrix());
  StereoRig rig{cameraOf(left.info), cameraOf(right.info)};
  rig.right_from_left.linear() = r_right.transpose() * r_left;
  rig.right_from_left.translation() = -baseline * r_right.transpose().col(0);
  return rig;
}

std::string infoText(const Camera& camera, const Eigen::Matrix3d& rectification,
                     const Eigen::Matrix<double, 3, 4>& projection) {
  CameraInfo info;
  info.name = camera.name;
  info.width = camera.width;
  info.height = camera.height;
  Eigen::Matrix3d k;
  k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  info.camera.set(k);
  for (int i = 0; i < 5; ++i) info.distortion.data(i) = camera.distortion[static_cast<std::size_t>(i)];
  info.rectification.set(rectification);
  info.projection.set(projection);
  return base::writeYaml(info);
}

}  // namespace

StereoRig parseStereoRig(const std::string& left, const std::string& right) {
  return rigOf(readInfo(left, "left camera_info"), readInfo(right, "right camera_info"));
}

StereoRig readStereoRig(const std::filesystem::path& left, const std::filesystem::path& right) {
  return rigOf(readInfo(base::readYamlTextFile(left), left.string()),
               readInfo(base::readYamlTextFile(right), right.string()));
}

std::array<std::string, 2> formatStereoRig(const StereoRig& rig) {
  // Rectified x points from the left camera centre to the right one, z between both views (Bouguet).
  const Eigen::Matrix3d rotation = rig.right_from_left.linear();
  const Eigen::Vector3d shift = rig.right_from_left.translation();
  const double baseline = rig.baseline();
  const Eigen::Vector3d x = -shift / baseline;
  const Eigen::Vector3d view = Eigen::Vector3d::UnitZ() + rotation.col(2);
  const Eigen::Vector3d y = view.cross(x).normalized();
  Eigen::Matrix3d r_right;
  r_right << x.transpose(), y.transpose(), x.cross(y).transpose();
  const Eigen::Matrix3d r_left = r_right * rotation;

  const double f = 0.5 * (rig.left.fy + rig.right.fy);
  Eigen::Matrix<double, 3, 4> p = Eigen::Matrix<double, 3, 4>::Zero();
  p << f, 0, 0.5 * (rig.left.cx + rig.right.cx), 0, 0, f, 0.5 * (rig.left.cy + rig.right.cy), 0, 0, 0, 1, 0;
  const std::string left = infoText(rig.left, r_left, p);
  p(0, 3) = -f * baseline;
  return {left, infoText(rig.right, r_right, p)};
}

void writeStereoRig(const StereoRig& rig, const std::filesystem::path& left,
                    const std::filesystem::path& right) {
  const auto [left_text, right_text] = formatStereoRig(rig);
  base::writeTextFile(left, left_text);
  base::writeTextFile(right, right_text);
}

}  // namespace capstan::vision
