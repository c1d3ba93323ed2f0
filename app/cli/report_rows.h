#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/experiments/identify_and_track.h"
#include "core/tracking/track_all.h"

namespace capstan::cli {

/// One of the report's three rows: tracked with nominal constants, what identification found, tracked again.
struct ReportRow {
  std::string name;                ///< "1 nominal"
  std::vector<std::string> cells;  ///< of q1, q2, q3: "2.592 / 0.361 / 2.588"; empty: `words` in their place
  std::string words;               ///< what was found
  std::string sentence;            ///< what it means, from its numbers
};

/// The three rows; two where the recording was not tracked again, the second says why. `own_kinematics`: the
/// reference is the robot's own kinematics, no truth.
std::vector<ReportRow> reportRows(const tracking::TrackReport& nominal,
                                  const experiments::IdentifyAndTrack& after, bool own_kinematics);

/// For a console, and for the report's page.
std::string textOf(const std::vector<ReportRow>& rows);
std::string htmlOf(const std::vector<ReportRow>& rows);

/// {"parameters": […], "method": …, "fault": …, "tracked": {"rms": …, "nis": …, …}}, SI.
nlohmann::json jsonOf(const experiments::IdentifyAndTrack& after, const tracking::SourceInfo& info);

}  // namespace capstan::cli
