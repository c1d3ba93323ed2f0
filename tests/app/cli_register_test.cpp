// `capstan-cli register`: a table of point pairs to the cameras' transform.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/app/cli_fixture.h"
#include "tests/support/disc_image.h"

namespace capstan::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class CliRegister : public Cli {
 protected:
  /// Pairs of a pure translation by 0.1, 0.2, 0.3 m; row 2 is off by 50 mm.
  void write(const std::string& name, const std::string& header, double scale) const {
    std::ofstream file(path(name));
    file << header << "\n";
    for (int i = 0; i < 8; ++i) {
      const double x = 0.02 * (i & 1), y = 0.03 * (i & 2), z = 0.01 * (i & 4);
      file << x + 0.1 << ',' << y + 0.2 << ',' << z + (i == 2 ? 0.35 : 0.3) << ',' << scale * x << ','
           << scale * y << ',' << scale * z << "\n";
    }
  }
};

TEST_F(CliRegister, RejectsTheOutlierAndWritesTheTransform) {
  write("p.csv", "x,y,z,cam_x,cam_y,cam_z", 1.0);
  const Ran ran = run("register " + path("p.csv") + " --json - --out " + path("r.yaml"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto found = nlohmann::json::parse(ran.out);
  EXPECT_EQ(found["rejected"], nlohmann::json({2}));
  EXPECT_EQ(found["residuals"].size(), 8u);
  EXPECT_NEAR(found["base_from_camera"]["position"][1].get<double>(), 0.2, 1e-9);
  EXPECT_THAT(textOf("r.yaml"), HasSubstr("rotation"));
}

TEST_F(CliRegister, PrintsTheResidualOfEveryRow) {
  write("p.csv", "x,y,z,cam_x,cam_y,cam_z", 1.0);
  const Ran ran = run("register " + path("p.csv"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(
      ran.out,
      HasSubstr("   row   residual [mm]\n     0           0.000   used\n     1           0.000   used\n"
                "     2          50.000   rejected\n"));
  EXPECT_THAT(ran.out, HasSubstr("     7           0.000   used\n"));
  EXPECT_THAT(ran.out, Not(HasSubstr("largest")));
}

TEST_F(CliRegister, PrintsTheLargestResidualsOfManyRows) {
  std::ofstream file(path("p.csv"));
  file << "x,y,z,cam_x,cam_y,cam_z\n";
  for (int i = 0; i < 40; ++i) {
    const double x = 0.02 * (i % 4), y = 0.03 * (i / 4 % 5), z = 0.02 * (i / 20);
    file << x + 0.1 << ',' << y + (i % 2 ? 0.2 : 0.2001) << ',' << z + (i == 7 ? 0.35 : 0.3) << ',' << x
         << ',' << y << ',' << z << "\n";
  }
  file.close();
  const Ran ran = run("register " + path("p.csv"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("residual [mm]\n     7          50.000   rejected\n"));
  EXPECT_THAT(ran.out, HasSubstr("These are the 10 largest residuals. The other 30 are 0.0"));
  const auto table = ran.out.substr(ran.out.find("residual [mm]"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 12);
}

TEST_F(CliRegister, NamesTheFaultAndTheRemedy) {
  write("mm.csv", "x,y,z,cam_x,cam_y,cam_z", 1000.0);
  Ran ran = run("register " + path("mm.csv"));
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("0.001 times as long. Give both in metres"));
  write("short.csv", "x,y,z,cam_x,cam_y,other", 1.0);
  ran = run("register " + path("short.csv"));
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("the column is missing"));
}

TEST_F(CliRegister, KeepsAHistoryAndComparesRegistrations) {
  write("p.csv", "x,y,z,cam_x,cam_y,cam_z", 1.0);
  write("mm.csv", "x,y,z,cam_x,cam_y,cam_z", 1000.0);
  std::ofstream(path("use.yaml"))
      << "translation: [0.1, 0.2, 0.303]\nrotation: [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n";
  const std::string history = " --history " + path("h.yaml");
  Ran ran = run("register " + path("p.csv") + history + " --compare " + path("use.yaml") + " --json -");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto difference = nlohmann::json::parse(ran.out)["difference"];
  EXPECT_NEAR(difference["translation"][2].get<double>(), -0.003, 1e-9);
  EXPECT_NEAR(difference["tool_largest"].get<double>(), 0.003, 1e-9);
  EXPECT_NEAR(difference["rotation"].get<double>(), 0.0, 1e-7);
  EXPECT_EQ(run("register " + path("mm.csv") + history).exit, 2);
  ran = run("registrations " + path("h.yaml") + " --json -");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto kept = nlohmann::json::parse(ran.out)["registrations"];
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0]["decision"], "accepted");
  EXPECT_EQ(kept[0]["excluded"], 1);
  EXPECT_NEAR(kept[0]["base_from_camera"]["position"][1].get<double>(), 0.2, 1e-9);
  EXPECT_EQ(kept[1]["decision"], "rejected");
  EXPECT_THAT(kept[1]["reason"].get<std::string>(), HasSubstr("0.001 times as long"));
  EXPECT_TRUE(kept[1]["base_from_camera"].is_null());

  ran = run("registrations " + path("h.yaml") + " --export 1 --out " + path("r.yaml") + " --compare 1 " +
            path("use.yaml"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("translation 3.00 mm (0.00, 0.00, 3.00), rotation 0.00°"));
  EXPECT_THAT(textOf("r.yaml"), HasSubstr("translation"));
  EXPECT_EQ(run("registrations --compare " + path("r.yaml") + " " + path("use.yaml")).out, ran.out);
  EXPECT_THAT(run("registrations " + path("h.yaml") + " --export 2 --out " + path("n.yaml")).err,
              HasSubstr("has no result"));
  EXPECT_THAT(run("registrations " + path("h.yaml") + " --compare 1 3").err, HasSubstr("has 2 entries"));
  EXPECT_THAT(run("registrations " + path("none.yaml")).err, HasSubstr("no such file"));
}

// Two cameras side by side, focal length 500 px, 60 mm apart, that see a tip at z = 0.3 m.
class CliRegisterPixels : public CliRegister {
 protected:
  void SetUp() override {
    fs::create_directories(path("cameras"));
    for (const std::string side : {"left", "right"}) {
      const std::string shift = side == "left" ? "0.0" : "-30.0";
      std::ofstream(path("cameras/" + side + ".yaml"))
          << "image_width: 640\nimage_height: 480\ncamera_name: " << side
          << "\ncamera_matrix: {rows: 3, cols: 3, data: [500, 0, 320, 0, 500, 240, 0, 0, 1]}\n"
             "distortion_model: plumb_bob\n"
             "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
             "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
             "projection_matrix: {rows: 3, cols: 4, data: [500, 0, 320, "
          << shift << ", 0, 500, 240, 0, 0, 0, 1, 0]}\n";
    }
    std::ofstream poses(path("poses.csv")), pixels(path("pixels.csv")), swapped(path("swapped.csv"));
    poses << "pair,x,y,z\n";
    pixels << "left_image,left_u,left_v,right_u,right_v,reason\n";
    swapped << "left_u,left_v,right_u,right_v\n";
    for (int i = 0; i < 16; ++i) {
      const double x = 0.02 * (i & 3) - 0.03, y = 0.03 * ((i >> 2) & 1), z = 0.3 + 0.03 * (i >> 3);
      poses << i << ',' << x + 0.1 << ',' << y << ',' << z << "\n";
      const double u = 320 + 500 * x / z, v = 240 + 500 * y / z, right = u - 30 / z;
      if (i == 5)
        pixels << "a.png,,,,,left: too small\n";
      else
        pixels << "a.png," << u << ',' << v << ',' << right << ',' << v << ",\n";
      swapped << right << ',' << v << ',' << u << ',' << v << "\n";
    }
  }
};

TEST_F(CliRegisterPixels, TakesTheTipFromAnotherTableAndSkipsWhatWasNotSeen) {
  const Ran ran = run("register " + path("pixels.csv") + " --poses " + path("poses.csv") + " --cameras " +
                      path("cameras") + " --json -");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto found = nlohmann::json::parse(ran.out);
  EXPECT_EQ(found["used"], 15);
  EXPECT_EQ(found["rows"], 16);
  EXPECT_EQ(found["skipped"][0]["row"], 5);
  EXPECT_TRUE(found["residuals"][5].is_null());
  EXPECT_NEAR(found["base_from_camera"]["position"][0].get<double>(), 0.1, 1e-3);
}

TEST_F(CliRegisterPixels, NamesExchangedCameras) {
  const std::string command =
      "register " + path("swapped.csv") + " --poses " + path("poses.csv") + " --cameras " + path("cameras");
  const Ran ran = run(command);
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("the left and the right pixels are exchanged. Give --exchange"));
  EXPECT_EQ(run(command + " --exchange").exit, 0);
}

TEST_F(CliRegister, PicturesWithoutTheBallNameTheWayToAnotherMarker) {
  std::ofstream(path("dark.ppm")) << "P6\n64 48\n255\n" << std::string(64 * 48 * 3, '\0');
  const Ran ran = run("detect " + path("dark.ppm") + " --right " + path("dark.ppm"));
  EXPECT_EQ(ran.exit, 1) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("--marker marker.yaml"));
}

// One click on the red mark of a da Vinci jaw, then all pairs, then the cameras' transform.
TEST_F(CliRegister, FromOneClickOnARealMarkToTheTransform) {
  const auto folder = test::dataFolder() / "davinci-red-marker";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const std::string data = folder.string();
  Ran ran = run("marker " + data + "/right05.jpg --at 320,266 --out " + path("marker.yaml"));
  ASSERT_EQ(ran.exit, 0) << ran.err;
  ran = run("detect " + data + "/left*.jpg --right " + data + "/right*.jpg --marker " + path("marker.yaml") +
            " --search frame --out " + path("centroids.csv") + " --json -");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_GE(nlohmann::json::parse(ran.out)["detected"], 9);
  ran = run("register " + path("centroids.csv") + " --poses " + data + "/poses.csv --cameras " + data +
            " --json -");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto found = nlohmann::json::parse(ran.out);
  EXPECT_GE(found["used"], 9);
  EXPECT_LE(found["leave_one_out_rms"].get<double>(), 1.2e-3);
}

TEST_F(CliRegister, DetectDrawsWhatItFound) {
  base::Random random(5);
  DiscScene scene;
  scene.width = 400;
  scene.height = 360;
  cv::imwrite(path("left.png"), renderDisc(scene, random));
  scene.radius = 0.0;
  cv::imwrite(path("right.png"), renderDisc(scene, random));
  const Ran ran =
      run("detect " + path("left.png") + " --right " + path("right.png") + " --overlays " + path("seen"));
  EXPECT_EQ(ran.exit, 1) << "no pair has both";
  const cv::Mat seen = cv::imread(path("seen/001_left.png"));
  ASSERT_EQ(seen.size(), cv::Size(800, 360));
  EXPECT_GT(seen.at<cv::Vec3b>(60, 80)[2], 240) << "the cross at the centroid; the disc is green";
  EXPECT_EQ(seen.at<cv::Vec3b>(0, 300), cv::Vec3b(255, 255, 255)) << "the frame of the marker enlarged";
  std::ofstream(path("file")) << "no folder";
  EXPECT_THAT(
      run("detect " + path("left.png") + " --right " + path("right.png") + " --overlays " + path("file/x"))
          .err,
      HasSubstr("Give another --overlays"));
}

TEST_F(CliRegister, MarkerAndDetectRefuseWithTheRemedy) {
  Ran ran = run("marker " + path("none.png") + " --at 3,4");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("none.png: is not there. Give the path of an image"));
  std::ofstream(path("text.png")) << "no picture";
  ran = run("marker " + path("text.png") + " --at 3,4");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("text.png: is not a readable image"));
  ran = run("detect a.png b.png --right c.png");
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("the left camera has 2"));
  std::ofstream(path("m.yaml")) << "hue_low: 400\n";
  ran = run("detect " + path("text.png") + " --right " + path("text.png") + " --marker " + path("m.yaml"));
  EXPECT_EQ(ran.exit, 2);
  EXPECT_THAT(ran.err, HasSubstr("m.yaml:1: hue_low = 400"));
}

}  // namespace
}  // namespace capstan::testing
