#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "app/cli/report_rows.h"
#include "core/tracking/track_all.h"

namespace capstan::cli {

/// What the front page of a report says besides the numbers.
struct ReportPage {
  std::string title, created, software;
  std::string recording;             ///< as the reader finds it: a file name
  std::string robot = {};            ///< whose kinematics the errors are of, and that the filter assumed
  std::vector<ReportRow> rows = {};  ///< from nominal to identified constants; empty: not there
  bool simulated = false;
  bool recorded_here = false;   ///< the recording lies in the folder itself
  bool own_kinematics = false;  ///< the reference is the robot's own kinematics
  bool plots = false, pictures = false;
  double plots_begin = 0.0, plots_end = 0.0;  ///< [s]
};

/// RMS errors, one row an estimator, columns in deg, deg, mm; empty cells (CSV) or "-" where nothing is
/// known.
std::string errorsCsv(const tracking::ErrorTable& errors);
std::string errorsMarkdown(const tracking::ErrorTable& errors);
std::string indexHtml(const ReportPage& page, const tracking::TrackReport& report);

/// The whole frame with the box that was searched, and beside it that box enlarged with the fitted circle.
cv::Mat drawDetection(const cv::Mat& bgr, const vision::MarkerDetection& marker);

/// What index.html of every report holds, by which a former report is known.
inline constexpr const char* kReportMark = "<meta name=\"generator\" content=\"Capstan report\">";
/// Every file a report may leave.
const std::vector<std::string>& reportFiles();

}  // namespace capstan::cli
