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

/// Results of one identification of a drive.
struct DriveFindings {
  identification::DriveReport report;
  identification::OffsetRule offsets = identification::OffsetRule::kEach;
  std::vector<std::string> training, held_out;  ///< names of the recordings
  identification::LinearDrive gear, stretch;
  std::vector<DriveModelScore> scores;  ///< errors of the models, from gear ratio to cable model
  bool sliding = false;                 ///< prismatic joint: units for people are mm, else degrees
};

/// Results as text for people, and as JSON in SI.
std::string textOf(const DriveFindings& findings);
nlohmann::json jsonOf(const DriveFindings& findings);

}  // namespace capstan::cli
