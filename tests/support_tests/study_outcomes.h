#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/planted_study/summary.h"

namespace capstan::study {

inline test::Truth::Item item(std::string_view effect, int joint, double size, double magnitude = 0.1) {
  test::Truth::Item one{std::string(effect), joint, size, 10.0 * size, {}};
  one.planted.effect = test::effectNamed(effect)->effect;
  one.planted.joint = std::max(joint - 1, 0);
  one.planted.magnitude = magnitude;
  return one;
}

/// One backlash of 0.1 m on joint 2, and what is said of it.
inline CaseOutcome backlashCase(const Answer& answer, double size = 0.5, std::uint64_t seed = 1) {
  return {
      {Kind::kOne, Robot::kRaven, "backlash", seed}, {{item("backlash", 2, size)}, {}, 30.0, 7.0}, answer};
}

inline NamedCause cause(std::string effect, int joint, std::vector<FoundNumber> numbers = {}) {
  return {std::move(effect), joint, 0.9, std::move(numbers)};
}

inline Answer answer(std::string verdict, std::vector<NamedCause> causes = {},
                     std::vector<std::vector<NamedCause>> ties = {}) {
  return {std::move(verdict), "", std::move(causes), std::move(ties), {}, 0.5, 2.0};
}

/// A file of this test's own, which goes with it.
class OwnFile {
 public:
  OwnFile() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("capstan_study_") + info->name() + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
  }
  ~OwnFile() { std::filesystem::remove_all(folder_); }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;
  std::filesystem::path path() const { return folder_ / "cases.jsonl"; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace capstan::study
