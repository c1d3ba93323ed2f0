/// The robot file and recordings of one jaw.
#pragma once

#include "core/identification/drive_fit.h"
#include "tests/support/folders.h"

namespace capstan::identification {

inline robot::Description jaw() {
  return robot::readDescription(capstan::test::sourceFile("tests/core/identification/data/davinci_jaw.yaml"));
}

/// Recordings of the jaw under even or odd load levels at 0.1, 0.3 and 0.5 Hz, in this order; empty where the
/// measured data are not here.
inline std::vector<DriveRecording> jawRecordings(bool odd, double step) {
  const std::filesystem::path root = capstan::test::dataFolder() / "davinci-jaw";
  std::vector<DriveRecording> all;
  if (!std::filesystem::exists(root)) return all;
  for (const char* frequency : {"0.1", "0.3", "0.5"})
    for (int load = odd ? 1 : 0; load < 10; load += 2)
      all.push_back(driveRecording(
          recording::readMeasuredTable(
              root / ("tool4_left_" + std::string(frequency) + "Hz_load" + std::to_string(load) + ".csv")),
          step));
  return all;
}

}  // namespace capstan::identification
