#include <nlohmann/json.hpp>

#include "core/base/checksum.h"
#include "core/learning/model/correction_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

/// The same file with the numbers' count and the checksum that its contents have: a stranger can compute
/// them.
std::string consistent(std::string_view bytes) {
  constexpr std::size_t kLongest = 1U << 16;
  const std::size_t first = bytes.find('\n');
  if (first == std::string_view::npos) return std::string(bytes);
  const std::size_t second = bytes.find('\n', first + 1);
  if (second == std::string_view::npos || second - first > kLongest) return std::string(bytes);
  auto header = nlohmann::json::parse(bytes.substr(first + 1, second - first - 1), nullptr, false);
  std::string numbers(bytes.substr(second + 1));
  numbers.resize(numbers.size() / sizeof(double) * sizeof(double));
  if (!header.is_object()) return std::string(bytes);
  header.erase("checksum");
  header["numbers"] = numbers.size() / sizeof(double);
  header["checksum"] = capstan::base::checksumOf(header.dump() + numbers);
  return std::string(bytes.substr(0, first + 1)) + header.dump() + "\n" + numbers;
}

}  // namespace

CAPSTAN_FUZZ_TARGET(correction_model) {
  using namespace capstan;
  fuzz::allowInputError([&] { learning::readCorrection(fuzz::fileOf(bytes, "as-given.correction")); });
  fuzz::allowInputError([&] {
    const auto file = learning::readCorrection(fuzz::fileOf(consistent(bytes), "arm.correction"));
    const learning::Corrected corrected =
        file.model.correct(Eigen::Isometry3d::Identity(), learning::Vector6d::Zero());
    fuzz::require(corrected.pose.matrix().allFinite(), "a corrected pose is finite");
    fuzz::require(corrected.sigma.allFinite(), "its standard deviations are finite");
  });
}
