// OpenCV itself writes the OpenCV files, and projects the points that our cameras must project alike.
#include "core/vision/rig_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "core/base/error.h"
#include "tests/core/vision/rig_for_tests.h"

namespace capstan::vision {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Format of kalibr_calibrate_cameras, with the numbers of its documentation's kind.
constexpr const char* kChain = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.11, 0.09, 0.0007, -0.0004]
  distortion_model: radtan
  intrinsics: [650.0, 652.0, 320.0, 240.0]
  resolution: [640, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [0.0, 0.0, 1.0, -0.048]
  - [0.0, 1.0, 0.0, 0.0]
  - [-1.0, 0.0, 0.0, 0.014]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [0]
  camera_model: pinhole
  distortion_coeffs: [0.0, 0.0, 0.0, 0.0]
  distortion_model: radtan
  intrinsics: [600.0, 601.0, 310.0, 230.0]
  resolution: [640, 480]
  rostopic: /cam1/image_raw
)";

class RigFile : public ::testing::Test {
 protected:
  RigFile() : folder_(fs::temp_directory_path() / ("capstan_rig_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~RigFile() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static std::string errorOf(const fs::path& path) {
    try {
      readRig(path);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }
  /// The chain with `from` replaced by `to`.
  fs::path chainWith(const std::string& from, const std::string& to) const {
    std::string text = kChain;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return write("chain.yaml", text.replace(at, from.size(), to));
  }
  fs::path folder_;
};

TEST_F(RigFile, EitherFileOfAFolderStandsForIt) {
  const StereoRig rig = readRig(write("camchain.yaml", kChain));
  writeStereoRig(rig, folder_ / "left.yaml", folder_ / "right.yaml");
  const StereoRig folder = readRig(folder_);
  EXPECT_EQ(folder.left.fx, 650.0);
  for (const char* name : {"left.yaml", "right.yaml"}) {
    const StereoRig file = readRig(folder_ / name);
    EXPECT_EQ(file.left.fx, folder.left.fx) << name;
    EXPECT_EQ(file.right_from_left.matrix(), folder.right_from_left.matrix()) << name;
  }
}

TEST_F(RigFile, KalibrChainHasItsNumbers) {
  const StereoRig rig = readRig(write("trial-camchain.yaml", kChain));
  EXPECT_EQ(rig.left.name, "cam0");
  EXPECT_EQ(rig.right.fy, 601.0);
  EXPECT_EQ(rig.left.distortion, (std::array<double, 5>{-0.11, 0.09, 0.0007, -0.0004, 0.0}));
  EXPECT_NEAR(rig.baseline(), 0.05, 1e-15);  // 48, 14 and 50 are Pythagorean
  // A point p of cam0 is (p_z − 0.048, p_y, 0.014 − p_x) in cam1: pixel = f (x/z, y/z) + c.
  const Eigen::Vector2d pixel = *rig.right.project(rig.right_from_left * Eigen::Vector3d(-0.486, 0.1, 0.098));
  EXPECT_NEAR(pixel.x(), 310.0 + 600.0 * 0.05 / 0.5, 1e-9);
  EXPECT_NEAR(pixel.y(), 230.0 + 601.0 * 0.1 / 0.5, 1e-9);
  EXPECT_EQ(readRig(folder_).left.fx, 650.0);  // the folder with this file
}

TEST_F(RigFile, TheLeftCameraIsTheOneOnTheLeft) {
  const StereoRig rig = readRig(chainWith("1.0, -0.048]", "1.0, 0.048]"));
  EXPECT_EQ(rig.left.name, "cam1");
  const Eigen::Vector3d point(0.01, -0.02, 0.5);  // cam1's; (0.014 − z, y, x − 0.048) is cam0's
  EXPECT_NEAR((rig.right_from_left * point - Eigen::Vector3d(0.014 - 0.5, -0.02, 0.01 - 0.048)).norm(), 0.0,
              1e-15);
}

TEST_F(RigFile, KalibrErrorsNameKeyAndRemedy) {
  EXPECT_THAT(errorOf(chainWith("radtan", "equidistant")),
              HasSubstr("chain.yaml:5: cam0.distortion_model = equidistant: is not radtan"));
  EXPECT_THAT(errorOf(chainWith("camera_model: pinhole", "camera_model: omni")),
              HasSubstr("cam0.camera_model = omni: is not pinhole"));
  EXPECT_THAT(errorOf(chainWith("[650.0, 652.0, 320.0, 240.0]", "[650.0, 652.0]")),
              HasSubstr("cam0.intrinsics"));
  EXPECT_THAT(errorOf(chainWith("  T_cn_cnm1:", "  T_other:")), HasSubstr("cam1.T_cn_cnm1: is missing"));
  EXPECT_THAT(errorOf(chainWith("cam1:", "cam7:")), HasSubstr("cam1: is missing"));
  EXPECT_THAT(errorOf(chainWith("[0.0, 1.0, 0.0, 0.0]", "[0.0, 2.0, 0.0, 0.0]")),
              HasSubstr("has no rotation"));
  EXPECT_THAT(errorOf(chainWith("-0.048]", "-48.0]")),
              HasSubstr("= 48: has a baseline that is not between 0 and 2 m"));
  EXPECT_THAT(errorOf(write("robot.yaml", "joints: 3\n")), HasSubstr("this is no camera chain of Kalibr"));
  EXPECT_THAT(errorOf(folder_ / "none.yaml"), HasSubstr("does not exist"));
}

/// The test rig's matrices, as a program with OpenCV has them.
struct Matrices {
  cv::Mat_<double> m1, d1, m2, d2, r = cv::Mat_<double>(3, 3), t = cv::Mat_<double>(3, 1);
  explicit Matrices(const StereoRig& rig) {
    const auto camera = [](const Camera& c, cv::Mat_<double>& m, cv::Mat_<double>& d) {
      m = (cv::Mat_<double>(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
      d = (cv::Mat_<double>(1, 5) << c.distortion[0], c.distortion[1], c.distortion[2], c.distortion[3],
           c.distortion[4]);
    };
    camera(rig.left, m1, d1);
    camera(rig.right, m2, d2);
    for (int i = 0; i < 3; ++i) {
      t(i, 0) = rig.right_from_left.translation()(i);
      for (int j = 0; j < 3; ++j) r(i, j) = rig.right_from_left.linear()(i, j);
    }
  }
};

TEST_F(RigFile,
       HugeNumbersAreNoRotation) {  // their products are not finite, and no comparison with these held
  EXPECT_THAT(errorOf(chainWith("[0.0, 0.0, 1.0, -0.048]", "[1e8, 1e8, -1e8, -0.048]")),
              HasSubstr("has no rotation"));
  EXPECT_THAT(errorOf(chainWith("[0.0, 0.0, 1.0, -0.048]", "[1e200, 1e200, 1e200, -0.048]")),
              HasSubstr("outside the allowed range"));
  EXPECT_THAT(errorOf(chainWith("[640, 480]", "[1e300, 480]")),
              HasSubstr("cam0.resolution[0] = 1e300: is outside"));
}

TEST_F(RigFile, NestedOpenCvFilesAreRefused) {  // they exhaust the stack of cv::FileStorage
  for (const char* name : {"rig.json", "rig.xml", "rig.yml"}) {
    const std::string text = std::string(name) == "rig.json" ? "{\"M1\": " + std::string(200'000, '[')
                             : std::string(name) == "rig.xml"
                                 ? "<?xml version=\"1.0\"?><opencv_storage>"
                                 : "%YAML:1.0\n---\nM1: " + std::string(200'000, '[');
    std::string tags;
    for (int i = 0; i < 100'000 && std::string(name) == "rig.xml"; ++i) tags += "<a>";
    EXPECT_THAT(errorOf(write(name, text + tags)), HasSubstr(name)) << name;
  }
}

TEST_F(RigFile, AnOpenCvMatrixHasTheNumbersThatItStates) {  // memory for 80 GB was asked for
  const auto matrix = [](const std::string& size, const std::string& data) {
    return "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\nM1: !!opencv-matrix\n   rows: " + size +
           "\n   cols: " + size + "\n   dt: d\n   data: [ " + data + " ]\n";
  };
  EXPECT_THAT(errorOf(write("huge.yml", matrix("100000", "1."))), HasSubstr("M1 = 0 x 0: has 1 numbers"));
  EXPECT_THAT(errorOf(write("nan.yml", matrix("1", ".Nan"))),
              HasSubstr("M1: has a number that is not finite"));
}

TEST_F(RigFile, OpenCvFilesOfOneAndOfTwoParts) {
  const Matrices cv_rig(testRig());
  cv::Mat axis;
  cv::Rodrigues(cv_rig.r, axis);
  for (const std::string suffix : {".yml", ".xml", ".json"})
    for (const bool two : {false, true}) {
      if (two && suffix == ".json") continue;
      SCOPED_TRACE(suffix + (two ? ", two parts" : ""));
      const fs::path parts = folder_ / ("parts" + suffix);
      fs::create_directories(parts);
      const fs::path inner = two ? parts / ("intrinsics" + suffix) : folder_ / ("rig" + suffix);
      cv::FileStorage file(inner.string(), cv::FileStorage::WRITE);
      file << "image_width" << 640 << "image_height" << 480 << "M1" << cv_rig.m1 << "D1" << cv_rig.d1 << "M2"
           << cv_rig.m2 << "D2" << cv_rig.d2;
      if (two) file.open((parts / ("extrinsics" + suffix)).string(), cv::FileStorage::WRITE);
      file << "R" << cv_rig.r << "T" << cv_rig.t;
      file.release();
      const StereoRig rig = readRig(two ? parts : inner);
      EXPECT_NEAR(rig.baseline(), testRig().baseline(), 1e-15);
      const std::vector<cv::Point3d> point = {{0.03, -0.02, 0.45}};
      std::vector<cv::Point2d> pixel;
      cv::projectPoints(point, axis, cv_rig.t, cv_rig.m2, cv_rig.d2, pixel);
      const Eigen::Vector2d ours =
          *rig.right.project(rig.right_from_left * Eigen::Vector3d(0.03, -0.02, 0.45));
      EXPECT_NEAR(ours.x(), pixel[0].x, 1e-8);
      EXPECT_NEAR(ours.y(), pixel[0].y, 1e-8);
    }
}

TEST_F(RigFile, OpenCvReadsWhatWeWrite) {
  const StereoRig rig = testRig();
  writeOpenCvRig(rig, folder_ / "out.yml");
  const cv::FileStorage file((folder_ / "out.yml").string(), cv::FileStorage::READ);
  cv::Mat_<double> m2, d1, t;
  file["M2"] >> m2;
  file["D1"] >> d1;
  file["T"] >> t;
  EXPECT_EQ(m2(1, 1), rig.right.fy);
  EXPECT_EQ(d1(0, 4), rig.left.distortion[4]);
  EXPECT_EQ(t(0, 0), rig.right_from_left.translation().x());
  EXPECT_NEAR((readRig(folder_ / "out.yml").right_from_left.matrix() - rig.right_from_left.matrix()).norm(),
              0.0, 1e-15);
}

TEST_F(RigFile, OpenCvErrorsNameKeyAndRemedy) {
  const auto errorWith = [&](const std::string& change, const cv::Mat& value) {
    const Matrices cv_rig(testRig());
    cv::FileStorage file((folder_ / "bad.yml").string(), cv::FileStorage::WRITE);
    if (change != "image_width") file << "image_width" << 640;
    file << "image_height" << 480;
    const std::map<std::string, cv::Mat> all = {{"M1", cv_rig.m1}, {"D1", cv_rig.d1}, {"M2", cv_rig.m2},
                                                {"D2", cv_rig.d2}, {"R", cv_rig.r},   {"T", cv_rig.t}};
    for (const auto& [key, matrix] : all)
      if (key != change || !value.empty()) file << key << (key == change ? value : matrix);
    file.release();
    return errorOf(folder_ / "bad.yml");
  };
  EXPECT_THAT(errorWith("image_width", {}), HasSubstr("image_width: is missing"));
  EXPECT_THAT(errorWith("M1", {}), HasSubstr("M1: is missing or no matrix"));
  EXPECT_THAT(errorWith("R", cv::Mat_<double>::ones(2, 3)), HasSubstr("R = 2 x 3: is no 3 x 3 matrix"));
  EXPECT_THAT(errorWith("D2", cv::Mat_<double>::ones(1, 8)),
              HasSubstr("D2 = 1: has a coefficient 6 that is not zero"));
  EXPECT_THAT(errorWith("T", (cv::Mat_<double>(3, 1) << -48.0, 0, 0)), HasSubstr("T = 48: has a baseline"));
  EXPECT_THAT(errorWith("T", (cv::Mat_<double>(3, 1) << 0, -0.05, 0)), HasSubstr("one above the other"));
  EXPECT_THAT(errorOf(write("broken.yml", "%YAML:1.0\n---\nM1: [1, 2\n  {")), HasSubstr("broken.yml"));
  EXPECT_THAT(errorOf(write("broken.xml", "<?xml version=\"1.0\"?><opencv_storage><M1>")),
              HasSubstr("broken.xml"));
}

}  // namespace
}  // namespace capstan::vision
