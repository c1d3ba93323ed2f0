#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/analysis/error_run.h"
#include "core/base/progress.h"
#include "core/experiments/tables.h"
#include "core/recording/session_file.h"
#include "core/tracking/health.h"
#include "core/tracking/track_all.h"

namespace capstan::analysis {

/// A file of settings: its name and its contents.
struct SettingsFile {
  std::string name, text;
};

/// The settings that a session ran with, as files: robot.yaml, filter.yaml, and where the session has them
/// marker.yaml, camera_left.yaml, camera_right.yaml, registration.yaml and truth.yaml.
std::vector<SettingsFile> settingsOf(const recording::SessionHeader& header);

/// Everything about one session that its export shows: of a session in the window, or of a recording.
struct SessionRecord {
  ErrorRun run;  ///< errors and trajectory
  tracking::TrackReport report;
  std::vector<tracking::HealthCheck> health;
  std::array<std::string, 3> joint_names;
  std::vector<recording::SessionEvent> events;
  std::vector<SettingsFile> settings;
};

/// Tracks a recording once, as trackRun() does, and gathers its record; `each` gets every snapshot. `robot`:
/// robot file of the estimator; empty: the recording's own. The record is unusable when `progress` was
/// cancelled. Throws base::InputError for unusable files.
SessionRecord recordOf(const std::filesystem::path& recording, const std::filesystem::path& robot,
                       base::Progress& progress, const std::function<void(const tracking::Snapshot&)>& each);

/// Tables of the record, NAME-report (tracking, gate, consistency of the filter, transmission errors),
/// NAME-health and NAME-events, where NAME is run.name.
std::vector<experiments::NamedTable> tablesOf(const SessionRecord& record);

}  // namespace capstan::analysis
