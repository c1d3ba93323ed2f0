#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "app/cli/report_rows.h"
#include "core/tracking/health.h"
#include "core/tracking/track_all.h"

namespace capstan::cli {

/// Texts and flags of the front page of a report, in addition to the numbers of tracking.
struct ReportPage {
  std::string title, created, software;
  std::string recording;             ///< file name of the recording
  std::string robot = {};            ///< robot of the kinematic errors and of the filter
  std::vector<ReportRow> rows = {};  ///< from nominal to identified constants; empty: none
  std::vector<tracking::HealthCheck> health = {};
  bool simulated = false;
  bool recorded_here = false;   ///< the recording lies in the folder itself
  bool own_kinematics = false;  ///< the reference is the robot's own kinematics
  bool plots = false, pictures = false;
  double plots_begin = 0.0, plots_end = 0.0;  ///< time that the plots show [s]
};

/// RMS errors as a table: one row per estimator, columns in deg, deg, mm. Unknown values are empty cells in
/// CSV and "-" in Markdown.
std::string errorsCsv(const tracking::ErrorTable& errors);
std::string errorsMarkdown(const tracking::ErrorTable& errors);
/// HTML of the front page.
std::string indexHtml(const ReportPage& page, const tracking::TrackReport& report);

/// Image of a detection: the whole frame with the searched box, and beside it the enlarged box with the
/// fitted circle.
cv::Mat drawDetection(const cv::Mat& bgr, const vision::MarkerDetection& marker);

/// Mark in index.html of every report, by which a former report is recognized.
inline constexpr const char* kReportMark = "<meta name=\"generator\" content=\"Capstan report\">";
/// Names of all files that a report may contain.
const std::vector<std::string>& reportFiles();

}  // namespace capstan::cli
