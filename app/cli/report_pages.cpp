#include "app/cli/report_pages.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "app/cli/health_output.h"
#include "app/cli/html_text.h"
#include "app/cli/track_output.h"
#include "core/base/units.h"

namespace capstan::cli {
namespace {

constexpr std::array<const char*, 4> kHeadings = {"RMS error", "q1 [deg]", "q2 [deg]", "q3 [mm]"};

struct ErrorRow {
  const char* name;
  std::array<double, 3> shown;  ///< [deg, deg, mm]
};

std::array<ErrorRow, 3> errorRows(const tracking::ErrorTable& errors) {
  const auto row = [](const char* name, const tracking::JointRms& rms) {
    const Eigen::Vector3d value = rms.value();
    return ErrorRow{name,
                    {base::toDegrees(value(0)), base::toDegrees(value(1)), base::toMillimetres(value(2))}};
  };
  return {row("kinematic", errors.kinematic()), row("camera", errors.camera()), row("UKF", errors.ukf())};
}

std::string cell(double value, const char* absent) {
  return std::isnan(value) ? std::string(absent) : fmt::format("{:.4f}", value);
}

std::string errorsHtml(const tracking::ErrorTable& errors) {
  std::string html = "<table>\n<tr>";
  for (const char* heading : kHeadings) html += fmt::format("<th>{}</th>", heading);
  html += "</tr>\n";
  for (const ErrorRow& row : errorRows(errors)) {
    html += fmt::format("<tr><th>{}</th>", row.name);
    for (const double value : row.shown) html += fmt::format("<td>{}</td>", cell(value, "–"));
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string numbersHtml(const tracking::TrackReport& report) {
  const auto percent = [](double share) {
    return std::isnan(share) ? std::string("–") : fmt::format("{:.2f} %", 100.0 * share);
  };
  const auto row = [](const char* name, const std::string& value) {
    return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, value);
  };
  std::string html = "<table>\n";
  html += row("Motor samples",
              fmt::format("{} over {:.3f} s", report.motor_samples, report.last_t - report.first_t));
  html += row("Camera samples", fmt::format("{} ({} pairs of images)", report.camera_samples, report.frames));
  html += row("Detection rate", fmt::format("left {}, right {}", percent(report.detectionRate(0)),
                                            percent(report.detectionRate(1))));
  html += row("Camera accepted by the filter", percent(report.gateShare(tracking::Gate::kOpen)));
  const auto nis = nisVerdict(report);
  html += row("NIS / 3 (consistent filter: 1)",
              nis ? fmt::format("{:.4f}, 95 % band {:.4f} … {:.4f}: {}", nis->mean, nis->band.low,
                                nis->band.high, nis->text())
                  : "–");
  html += "</table>\n";
  if (nis && !nis->passed()) html += fmt::format("<p>NIS: {}.</p>\n", nis->advice());
  return html;
}

std::string linkHtml(const std::string& file) {
  return fmt::format("<li><a href=\"{0}\">{0}</a></li>\n", escaped(file));
}

constexpr const char* kStyle =
    "<style>body{font:16px/1.5 sans-serif;max-width:76rem;margin:2rem auto;padding:0 1rem;color:#1a1a1a}"
    "table{border-collapse:collapse;margin:1rem 0}th,td{padding:.25rem .9rem;border-bottom:1px solid #ccc;"
    "text-align:left}td{text-align:right;font-variant-numeric:tabular-nums}td.words{text-align:left}"
    "img{max-width:100%}</style>\n";

}  // namespace

const std::vector<std::string>& reportFiles() {
  static const std::vector<std::string> files = {
      "session.capstan", "session.capstan-wal", "session.capstan-shm", "joints.png",
      "joints.pdf",      "joints.svg",          "joints.csv",          "left.png",
      "right.png",       "errors.csv",          "errors.md",           "estimates.csv",
      "index.html"};
  return files;
}

std::string errorsCsv(const tracking::ErrorTable& errors) {
  std::string text = "estimator,q1_rms_deg,q2_rms_deg,q3_rms_mm\n";
  for (const ErrorRow& row : errorRows(errors)) {
    text += row.name;
    for (const double value : row.shown)
      text += std::isnan(value) ? std::string(",") : fmt::format(",{:.17g}", value);
    text += '\n';
  }
  return text;
}

std::string errorsMarkdown(const tracking::ErrorTable& errors) {
  std::string text;
  for (const char* heading : kHeadings) text += fmt::format("| {} ", heading);
  text += "|\n|---|---:|---:|---:|\n";
  for (const ErrorRow& row : errorRows(errors)) {
    text += fmt::format("| {} ", row.name);
    for (const double value : row.shown) text += fmt::format("| {} ", cell(value, "-"));
    text += "|\n";
  }
  return text;
}

std::string indexHtml(const ReportPage& page, const tracking::TrackReport& report) {
  const std::string title = escaped(page.title);
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
  html += std::string(kReportMark) + "\n<title>" + title + "</title>\n" + kStyle + "</head><body>\n";
  html += "<h1>" + title + "</h1>\n";
  html += fmt::format("<p>{}, {}. Recording: {}.</p>\n", escaped(page.software), escaped(page.created),
                      escaped(page.recording));
  if (page.simulated)
    html +=
        "<p><strong>The robot of this report is simulated: its errors are those of a model, not of a "
        "machine.</strong></p>\n";
  if (report.cancelled) html += "<p><strong>Cancelled: the numbers cover the time until then.</strong></p>\n";
  if (!page.rows.empty()) html += htmlOf(page.rows);
  html += page.own_kinematics
              ? "<h2>Differences from the robot's own kinematics</h2>\n<p>These are not errors: "
                "the recording holds no truth.</p>\n"
              : "<h2>Errors against the joint encoders</h2>\n";
  if (!page.robot.empty()) html += fmt::format("<p>Kinematics and filter of {}.</p>\n", escaped(page.robot));
  html += errorsHtml(report.errors);
  if (report.errors.ukf().count() == 0) html += "<p>The recording holds no reference.</p>\n";
  html += "<h2>Tracking</h2>\n" + numbersHtml(report) + healthHtml(page.health);
  if (page.plots)
    html += fmt::format(
        "<h2>Joints</h2>\n<p>{:.2f} s to {:.2f} s. Curves are drawn with at most 200 points per second and "
        "one per camera sample; the table above counts every tracked motor sample."
        "</p>\n<a href=\"joints.svg\"><img src=\"joints.png\" "
        "alt=\"Joint angles over time\"></a>\n",
        page.plots_begin, page.plots_end);
  if (page.pictures)
    html +=
        "<h2>Last pair of images</h2>\n<p>Left camera, then right: whole frame with the searched region, and "
        "that region with the fitted circle.</p>\n<img src=\"left.png\" alt=\"Left camera\">\n<img "
        "src=\"right.png\" alt=\"Right camera\">\n";
  html += "<h2>Files</h2>\n<ul>\n";
  if (page.recorded_here) html += linkHtml("session.capstan");
  for (const char* file : {"errors.csv", "errors.md", "estimates.csv"}) html += linkHtml(file);
  if (page.plots)
    for (const char* file : {"joints.png", "joints.pdf", "joints.svg", "joints.csv"}) html += linkHtml(file);
  if (page.pictures)
    for (const char* file : {"left.png", "right.png"}) html += linkHtml(file);
  return html + "</ul>\n</body></html>\n";
}

cv::Mat drawDetection(const cv::Mat& bgr, const vision::MarkerDetection& marker) {
  const cv::Scalar box_colour(0, 200, 255), circle_colour(255, 0, 255);
  const auto& r = marker.roi;
  const cv::Rect whole(0, 0, bgr.cols, bgr.rows);
  cv::Rect roi = cv::Rect(r[0], r[1], r[2], r[3]) & whole;
  if (roi.empty()) roi = whole;
  const double scale = static_cast<double>(bgr.rows) / std::max(roi.width, roi.height);
  cv::Mat canvas(bgr.rows, bgr.cols + bgr.rows, CV_8UC3, cv::Scalar::all(32));
  cv::Mat frame = canvas(whole);
  bgr.copyTo(frame);
  cv::rectangle(frame, roi, box_colour, 1);
  cv::Mat enlarged;
  cv::resize(bgr(roi), enlarged, {}, scale, scale, cv::INTER_NEAREST);
  if (marker.found()) {
    constexpr int kShift = 4;  // OpenCV's fixed point: sixteenths of a pixel
    const auto fixed = [](double value) { return static_cast<int>(std::lround(value * (1 << kShift))); };
    const cv::Point centre(fixed((marker.centroid.x() - roi.x + 0.5) * scale - 0.5),
                           fixed((marker.centroid.y() - roi.y + 0.5) * scale - 0.5));
    cv::circle(enlarged, centre, fixed(marker.radius * scale), circle_colour, 1, cv::LINE_AA, kShift);
    cv::circle(enlarged, centre, fixed(2.0), circle_colour, cv::FILLED, cv::LINE_AA, kShift);
  } else {
    cv::putText(enlarged, std::string(base::nameOf(marker.fault)), {12, 28}, cv::FONT_HERSHEY_SIMPLEX, 0.6,
                box_colour, 1, cv::LINE_AA);
  }
  enlarged.copyTo(canvas(cv::Rect(bgr.cols, 0, bgr.rows, bgr.rows) &
                         cv::Rect(bgr.cols, 0, enlarged.cols, enlarged.rows)));
  return canvas;
}

}  // namespace capstan::cli
