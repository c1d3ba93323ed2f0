#include "core/tracking/option_changes.h"

#include <gtest/gtest.h>

namespace capstan::tracking {
namespace {

TEST(OptionChanges, NamesWhatDiffersAsTheFileWritesIt) {
  TrackingOptions before, after;
  EXPECT_EQ(optionChanges(before, after), "");
  after.one_camera = OneCamera::kRay;
  after.gate_probability = 0.99;
  after.kinematic_sigma = {0.02, 0.01, 0.002};
  EXPECT_EQ(optionChanges(before, after),
            "kinematic_sigma: [0.02, 0.01, 0.002], one_camera: ray, gate_probability: 0.99");
  EXPECT_EQ(optionChanges(after, before),
            "kinematic_sigma: [0.02, 0.01, 0.001], one_camera: kinematics, gate_probability: 0.999");
}

/// Every option is compared, also the last one of the file.
TEST(OptionChanges, SeesEveryOption) {
  const TrackingOptions before;
  int seen = 0, options = 0;
  TrackingOptions::visit(before, [&](const auto&, const base::FieldInfo&) { ++options; });
  for (int chosen = 0; chosen < options; ++chosen) {
    TrackingOptions after;
    int at = 0;
    std::string key;
    TrackingOptions::visit(after, [&](auto& field, const base::FieldInfo& info) {
      if (at++ != chosen) return;
      using Field = std::remove_cvref_t<decltype(field)>;
      key = info.key;
      if constexpr (std::is_same_v<Field, bool>)
        field = !field;
      else if constexpr (std::is_enum_v<Field>)
        field = field == Field{} ? static_cast<Field>(1) : Field{};
      else if constexpr (std::is_arithmetic_v<Field>)
        field += 1;
      else
        field(0) += 1.0;
    });
    const std::string words = optionChanges(before, after);
    EXPECT_EQ(words.rfind(key + ": ", 0), 0u) << words;
    EXPECT_EQ(words.find(", ") == std::string::npos || words.find('[') != std::string::npos, true) << words;
    ++seen;
  }
  EXPECT_GT(seen, 40);
}

}  // namespace
}  // namespace capstan::tracking
