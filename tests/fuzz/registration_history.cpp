#include "core/registration/registration_history.h"

#include <algorithm>

#include "tests/fuzz/fuzz_target.h"

/// A history that can be read is read again as it was written, with one entry more.
CAPSTAN_FUZZ_TARGET(registration_history) {
  using namespace capstan;
  fuzz::allowInputError([&] {
    const auto file = fuzz::fileOf(bytes, "registrations.yaml");
    const std::vector<registration::HistoryEntry> before = registration::readHistory(file);
    for (const registration::HistoryEntry& entry : before)
      if (const auto pose = entry.pose()) fuzz::require(pose->matrix().allFinite(), "a pose is finite");
    registration::HistoryEntry added;
    added.date = "2020-01-01T00:00:00";
    added.robot = "one";
    const auto after = registration::addToHistory(file, added);
    fuzz::require(after.size() <= std::min(before.size() + 1, registration::kMostHistory),
                  "a history grows by one entry and up to its limit");
    fuzz::require(registration::readHistory(file).size() == after.size(), "what was written can be read");
  });
}
