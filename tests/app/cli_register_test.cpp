// `capstan-cli register`: a table of point pairs to the cameras' transform.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/cli_fixture.h"

namespace capstan::testing {
namespace {

using ::testing::HasSubstr;

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

}  // namespace
}  // namespace capstan::testing
