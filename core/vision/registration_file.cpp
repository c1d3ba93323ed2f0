#include "core/vision/registration_file.h"

#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::vision {
namespace {

struct RegistrationFile {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.translation, {"translation", "m", "translation of base_from_camera", {-100.0, 100.0}});
    field(self.rotation, {"rotation", "", "rotation of base_from_camera, by rows", kRotationRange});
  }
};

}  // namespace

bool isRotation(const Eigen::Matrix3d& rotation) {
  const double far = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  return far < 1e-6 && rotation.determinant() > 0.0;
}

Eigen::Isometry3d readRegistration(const std::filesystem::path& path) {
  const auto fields = base::readYamlFile<RegistrationFile>(path);
  if (!isRotation(fields.rotation))
    throw base::InputError(
        {path.string(), 0, "rotation", {}, "is no rotation matrix", "Give one whose rows are orthonormal"});
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  base_from_camera.linear() = fields.rotation;
  base_from_camera.translation() = fields.translation;
  return base_from_camera;
}

std::string formatRegistration(const Eigen::Isometry3d& base_from_camera) {
  return base::writeYaml(RegistrationFile{base_from_camera.translation(), base_from_camera.linear()});
}

void writeRegistration(const Eigen::Isometry3d& base_from_camera, const std::filesystem::path& path) {
  base::writeTextFile(path, formatRegistration(base_from_camera));
}

}  // namespace capstan::vision
