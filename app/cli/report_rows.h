#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/experiments/identify_and_track.h"
#include "core/tracking/track_all.h"

namespace capstan::cli {

/// Row of the report's three: tracked with nominal constants, result of identification, tracked again.
struct ReportRow {
  std::string name;                ///< "1 nominal"
  std::vector<std::string> cells;  ///< RMS of q1, q2, q3: "2.592 / 0.361 / 2.588"; empty: `words` instead
  std::string words;               ///< identified constants
  std::string sentence;            ///< meaning of the row's numbers
};

/// Returns the three rows, or two where the recording was not tracked again; the second then gives the
/// reason. `own_kinematics`: the reference is the robot's own kinematics, not a true reference.
std::vector<ReportRow> reportRows(const tracking::TrackReport& nominal,
                                  const experiments::IdentifyAndTrack& after, bool own_kinematics);

/// Text of the rows for a console, and HTML for the report's page.
std::string textOf(const std::vector<ReportRow>& rows);
std::string htmlOf(const std::vector<ReportRow>& rows);

/// JSON in SI: {"parameters": […], "method": …, "fault": …, "tracked": {"rms": …, "nis": …, …}}.
nlohmann::json jsonOf(const experiments::IdentifyAndTrack& after, const tracking::SourceInfo& info);

}  // namespace capstan::cli
