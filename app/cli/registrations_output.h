#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "core/registration/registration_difference.h"
#include "core/registration/registration_history.h"

namespace capstan::cli {

/// Table of the entries for people, one a line, numbered from 1.
std::string tableOf(std::span<const registration::HistoryEntry> entries);
nlohmann::json documentOf(std::span<const registration::HistoryEntry> entries);
nlohmann::json documentOf(const registration::RegistrationDifference& difference);

/// Registration that `text` names: the number of an entry of the history, counted from 1, or the path of a
/// registration file. Throws base::InputError, also for an entry without a result.
Eigen::Isometry3d registrationOf(const std::string& text,
                                 std::span<const registration::HistoryEntry> entries);

}  // namespace capstan::cli
