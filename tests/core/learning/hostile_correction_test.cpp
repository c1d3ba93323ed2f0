// Models of strangers: the check sum of the file holds, its numbers are impossible.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/yaml.h"
#include "core/learning/model/correction_file.h"
#include "tests/support/temporary_folder.h"

namespace capstan::learning {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class HostileCorrection : public ::testing::Test {
 protected:
  HostileCorrection() {
    base::Random random(5, "states");
    std::vector<State> states(60);
    for (State& state : states) {
      for (int i = 0; i < 3; ++i) state.pair.observed.translation()[i] = random.uniform(-0.05, 0.05);
      state.pair.commanded = state.pair.observed;
    }
    CorrectionOptions options;
    options.likelihood_points = options.inducing_points = 25;
    options.calibrate = false;
    writeCorrection({CorrectionModel::trained(states, options), {}}, path_);
    const std::string text = base::readTextFile(path_);
    const std::size_t first = text.find('\n'), second = text.find('\n', first + 1);
    magic_ = text.substr(0, first + 1);
    header_ = Json::parse(text.substr(first + 1, second - first));
    numbers_ = text.substr(second + 1);
  }

  /// What reading the file with this header and these numbers complains of; its count and check sum hold.
  std::string complaintOf(Json header, const std::string& numbers) const {
    header.erase("checksum");
    header["numbers"] = numbers.size() / sizeof(double);
    header["checksum"] = base::checksumOf(header.dump() + numbers);
    return complaintOf(magic_ + header.dump() + "\n" + numbers);
  }
  std::string complaintOf(const std::string& text) const {
    base::writeTextFile(path_, text);
    try {
      readCorrection(path_);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }
  /// The numbers with the one at `index` replaced.
  std::string with(std::size_t index, double value) const {
    std::string numbers = numbers_;
    std::memcpy(&numbers[index * sizeof value], &value, sizeof value);
    return numbers;
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "arm.correction";
  std::string magic_, numbers_;
  Json header_;
};

TEST_F(HostileCorrection, IsReadAsItWasWritten) { EXPECT_EQ(complaintOf(header_, numbers_), ""); }

TEST_F(HostileCorrection, CountsAreWholeAndHaveTheirNumbers) {  // memory for 10^18 numbers was asked for
  for (const Json& count : {Json(1'000'000'000), Json(-9223372036854775807), Json(1e300), Json(4.5),
                            Json("5"), Json(3000000000000000000)}) {
    Json header = header_;
    header["groups"][0][0]["inducing"] = count;
    EXPECT_THAT(complaintOf(header, numbers_), HasSubstr("says what no model says")) << count.dump();
    header = header_;
    header["source"]["states"] = count;
    if (count == Json(1'000'000'000)) continue;  // a possible number of states
    EXPECT_THAT(complaintOf(header, numbers_), HasSubstr("says what no model says")) << count.dump();
  }
}

TEST_F(HostileCorrection, NumbersAreFiniteAndPossible) {  // a matrix B without a factor aborted the program
  constexpr std::size_t kOffset = 0, kQuaternion = 16, kLever = 20;
  EXPECT_THAT(complaintOf(header_, with(kOffset, std::nan(""))), HasSubstr("offset"));
  EXPECT_THAT(complaintOf(header_, with(kOffset, 1.1)), HasSubstr("offset"));
  EXPECT_THAT(complaintOf(header_, with(kQuaternion, 2.0)), HasSubstr("mean rotation"));
  EXPECT_THAT(complaintOf(header_, with(kLever, -1.0)), HasSubstr("lever"));
  for (std::size_t index = 33; index < numbers_.size() / sizeof(double); index += 7)
    EXPECT_THAT(complaintOf(header_, with(index, std::nan(""))), HasSubstr("says what no model says"))
        << index;
}

TEST_F(HostileCorrection, MatrixWithoutAFactorIsRefused) {
  const Json& member = header_["groups"][0][0];
  const auto lengths = member["lengths"].get<std::size_t>(), inducing = member["inducing"].get<std::size_t>();
  constexpr std::size_t kFeatures = 12, kFirstMember = 33 + 2 * kFeatures + 2 * 6;
  const std::size_t square = kFirstMember + 2 + lengths + inducing * kFeatures;
  EXPECT_THAT(complaintOf(header_, with(square, -1.0)), HasSubstr("matrix B"));
}

TEST_F(HostileCorrection,
       ADeepHeaderIsRefused) {  // writing it out again for the check sum exhausted the stack
  EXPECT_THAT(complaintOf(magic_ + R"({"checksum": "0", "numbers": 0, "x": )" + std::string(200'000, '[') +
                          std::string(200'000, ']') + "}\n"),
              HasSubstr("damaged second line"));
}

}  // namespace
}  // namespace capstan::learning
