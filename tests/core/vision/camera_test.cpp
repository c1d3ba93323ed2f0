#include "core/vision/camera.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/calib3d.hpp>
#include <string>

#include "core/base/error.h"
#include "core/base/random.h"
#include "tests/core/vision/rig_for_tests.h"
#include "tests/support/folders.h"

namespace capstan::vision {
namespace {

cv::Mat matrixOf(const Camera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

TEST(Camera, ProjectsAsOpenCvDoes) {
  const Camera camera = testRig().left;
  base::Random random(1);
  std::vector<cv::Point3d> points;
  for (int i = 0; i < 500; ++i) {
    const double z = random.uniform(0.2, 1.0);
    points.emplace_back(z * random.uniform(-0.45, 0.45), z * random.uniform(-0.35, 0.35), z);
  }
  std::vector<cv::Point2d> expected;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), matrixOf(camera),
                    std::vector<double>(camera.distortion.begin(), camera.distortion.end()), expected);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pixel = camera.project({points[i].x, points[i].y, points[i].z});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), expected[i].x, 1e-10);
    EXPECT_NEAR(pixel->y(), expected[i].y, 1e-10);
  }
}

TEST(Camera, NormaliseUndoesProjectToTheLastDigits) {
  base::Random random(2);
  for (const double strength : {0.0, 1.0, 3.0}) {
    Camera camera = testRig().left;
    for (double& coefficient : camera.distortion) coefficient *= strength;
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector2d ideal(random.uniform(-0.5, 0.5), random.uniform(-0.38, 0.38));
      const auto pixel = camera.project(ideal.homogeneous());
      ASSERT_TRUE(pixel);
      EXPECT_LT((camera.normalise(*pixel) - ideal).norm(), 1e-12);
    }
  }
}

TEST(Camera, SeesNothingBehindIt) {
  const Camera camera = testRig().left;
  EXPECT_FALSE(camera.project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(camera.project({0.1, 0.0, -0.5}));
  EXPECT_FALSE(camera.project({0.1, 0.0, std::nan("")}));
}

void expectSame(const StereoRig& a, const StereoRig& b) {
  for (const auto& [x, y] : {std::pair{a.left, b.left}, {a.right, b.right}}) {
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.width, y.width);
    EXPECT_EQ(x.height, y.height);
    EXPECT_EQ(x.fx, y.fx);
    EXPECT_EQ(x.fy, y.fy);
    EXPECT_EQ(x.cx, y.cx);
    EXPECT_EQ(x.cy, y.cy);
    EXPECT_EQ(x.distortion, y.distortion);
  }
  // Intrinsics come back to the last bit. The file holds the transform as two rectifying rotations and a
  // baseline: their product is rounded, hence 1e-12 and not 0.
  EXPECT_LT((a.right_from_left.matrix() - b.right_from_left.matrix()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(StereoRig, ComesBackFromItsFiles) {
  base::Random random(3);
  for (int i = 0; i < 50; ++i) {
    StereoRig rig = testRig();
    rig.left.fx += random.uniform(-5, 5);
    rig.right.distortion[2] = random.uniform(-1e-3, 1e-3);
    rig.right_from_left.linear() =
        Eigen::AngleAxisd(random.uniform(0, 0.2),
                          Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized())
            .toRotationMatrix();
    rig.right_from_left.translation() = Eigen::Vector3d(
        random.uniform(-0.1, -0.03), random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01));
    const auto [left, right] = formatStereoRig(rig);
    expectSame(rig, parseStereoRig(left, right));
  }
}

TEST(StereoRig, RectifiesAsTheRosConventionSays) {
  // sensor_msgs/CameraInfo: R turns a camera's points into the rectified frame; P_left and P_right both act
  // on points of the left rectified frame, and [fx' 0 cx'; 0 fy' cy'; 0 0 1] of P_right on those of the right
  // one.
  struct Info {
    Eigen::Matrix3d r;
    Eigen::Matrix<double, 3, 4> p;
    explicit Info(const std::string& text) {
      const YAML::Node info = YAML::Load(text);
      for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = info["rectification_matrix"]["data"][i].as<double>();
      for (int i = 0; i < 12; ++i) p(i / 4, i % 4) = info["projection_matrix"]["data"][i].as<double>();
    }
  };
  const StereoRig rig = testRig();
  const auto [left_text, right_text] = formatStereoRig(rig);
  const Info left(left_text), right(right_text);
  const Eigen::Vector3d point(0.03, -0.02, 0.55);
  const Eigen::Vector3d rectified = left.r * point;
  const Eigen::Vector2d l = (left.p * rectified.homogeneous()).hnormalized();
  const Eigen::Vector2d r = (right.p * rectified.homogeneous()).hnormalized();
  const Eigen::Vector2d own = (right.p.leftCols<3>() * right.r * (rig.right_from_left * point)).hnormalized();
  EXPECT_LT((r - own).norm(), 1e-9);
  EXPECT_NEAR(l.y(), r.y(), 1e-9);
  EXPECT_NEAR(l.x() - r.x(), left.p(0, 0) * rig.baseline() / rectified.z(), 1e-9);
}

TEST(StereoRig, DefaultRigIsTheLaboratorysPair) {
  const std::string folder = test::resourceFile("cameras/");
  const StereoRig rig = readStereoRig(folder + "left.yaml", folder + "right.yaml");
  EXPECT_NEAR(rig.baseline(), 0.048, 1e-12);
  EXPECT_EQ(rig.left.width, 640);
  EXPECT_EQ(rig.left.height, 480);
  EXPECT_NEAR(rig.left.fx, 650.0, 10.0);
  EXPECT_NEAR(rig.right.fx, 650.0, 10.0);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

base::InputFault faultOf(const std::string& left, const std::string& right) {
  try {
    parseStereoRig(left, right);
  } catch (const base::InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(StereoRig, RefusesBrokenFilesWithPlaceAndRemedy) {
  const auto [left, right] = formatStereoRig(testRig());
  base::InputFault fault = faultOf(replaced(left, "plumb_bob", "equidistant"), right);
  EXPECT_EQ(fault.file, "left camera_info");
  EXPECT_EQ(fault.key, "distortion_model");
  EXPECT_EQ(fault.line, 8);
  EXPECT_FALSE(fault.remedy.empty());

  fault = faultOf(left, replaced(right, "image_width: 640", "image_width: wide"));
  EXPECT_EQ(fault.file, "right camera_info");
  EXPECT_EQ(fault.key, "image_width");
  EXPECT_EQ(fault.line, 1);

  fault = faultOf(left, replaced(right, "camera_matrix", "kamera_matrix"));
  EXPECT_EQ(fault.key, "kamera_matrix");
  EXPECT_EQ(fault.remedy, "Did you mean camera_matrix?");
  EXPECT_EQ(faultOf(left, replaced(right, "image_height: 480", "image_height: 240")).key, "image_width");

  fault = faultOf(right, left);
  EXPECT_EQ(fault.key, "projection_matrix.data");
  EXPECT_NE(fault.remedy.find("Exchange"), std::string::npos);

  fault = faultOf(left, left);
  EXPECT_NE(fault.reason.find("no baseline"), std::string::npos);
}

}  // namespace
}  // namespace capstan::vision
