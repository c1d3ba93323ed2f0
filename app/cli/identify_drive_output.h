#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/identification/drive_identification.h"

namespace capstan::cli {

/// Errors of one model of the drive.
struct DriveModelScore {
  std::string key, words;
  identification::DriveScore training, held_out;
};

/// Everything that one identification of a drive has to say.
struct DriveFindings {
  identification::DriveReport report;
  identification::OffsetRule offsets = identification::OffsetRule::kEach;
  std::vector<std::string> training, held_out;  ///< names of the recordings
  identification::LinearDrive gear, stretch;
  std::vector<DriveModelScore> scores;  ///< from the robot file's gear ratio to the cable model
  bool sliding = false;                 ///< a prismatic joint: millimetres instead of degrees
};

std::string textOf(const DriveFindings& findings);
nlohmann::json jsonOf(const DriveFindings& findings);

}  // namespace capstan::cli
