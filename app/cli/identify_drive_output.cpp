#include "app/cli/identify_drive_output.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "core/base/units.h"

namespace capstan::cli {
namespace {

using identification::DriveEstimate;
using identification::DriveScore;
using identification::OffsetRule;

/// `text` padded with spaces to `width` characters (not bytes).
std::string padded(const std::string& text, std::size_t width) {
  std::size_t characters = 0;
  for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  return text + std::string(width > characters ? width - characters : 1, ' ');
}

std::string nameOf(const std::string& file) { return std::filesystem::path(file).filename().string(); }

/// Factor from SI to the unit for people: degrees, or millimetres for a sliding joint.
double scaleOf(const DriveFindings& findings) {
  return findings.sliding ? base::toMillimetres(1.0) : base::toDegrees(1.0);
}
const char* unitOf(const DriveFindings& findings) { return findings.sliding ? "mm" : "deg"; }

std::string parameterTable(const DriveFindings& findings) {
  std::string text = padded("parameter", 16) + padded("nominal", 12) + padded("identified", 24) + "change\n";
  for (const DriveEstimate& estimate : findings.report.estimates) {
    const auto& parameter = estimate.parameter;
    const double scale = parameter.scale();
    text += padded(parameter.name() + " [" + parameter.unit() + "]", 16) +
            padded(fmt::format("{:.5g}", scale * parameter.nominal), 12);
    text +=
        estimate.seen
            ? padded(fmt::format("{:.5g} ± {:.2g}", scale * estimate.value(), scale * estimate.valueSigma()),
                     24) +
                  fmt::format("{:+.1f} %\n", estimate.percent())
            : padded("not observable", 24) + "—\n";
  }
  const auto& drive = findings.report.robot.drives.front();
  text += fmt::format("  k_c = 2 k_e a; robot file: k_e {:.5g} N, a {:.5g} 1/m\n", drive.cable_stiffness,
                      drive.cable_exponent);
  for (const DriveEstimate& estimate : findings.report.estimates)
    if (!estimate.advice.empty())
      text += fmt::format("  {}: {}\n", estimate.parameter.name(), estimate.advice);
  return text;
}

std::string offsetsText(const DriveFindings& findings) {
  const auto& report = findings.report;
  std::string text =
      fmt::format("encoder zero relative to the robot file's hard stop [{}]:\n", unitOf(findings));
  for (const auto& offset : report.offsets)
    text +=
        "  " + padded(nameOf(offset.title), 32) +
        fmt::format("{:+.2f} ± {:.2f}\n", scaleOf(findings) * offset.value, scaleOf(findings) * offset.sigma);
  constexpr double kFollows = 0.9;
  if (std::abs(report.offset_load_correlation) > kFollows)
    text += fmt::format(
        "  The zeros change with the mean load by {:+.1f} {} per {} (correlation {:+.2f}). Probably the "
        "cable is "
        "stretched by the load, and the encoder has one zero. Compare with --offsets shared.\n",
        scaleOf(findings) * report.offset_by_load, unitOf(findings), findings.sliding ? "N" : "N·m",
        report.offset_load_correlation);
  return text;
}

std::string scoreTable(const DriveFindings& findings) {
  const bool tested = !findings.held_out.empty();
  std::string text = padded(fmt::format("RMS of the joint [{}]", unitOf(findings)), 32) +
                     padded("training", 12) + (tested ? "held out\n" : "\n");
  for (const DriveModelScore& score : findings.scores) {
    text +=
        padded(score.words, 32) + padded(fmt::format("{:.3f}", scaleOf(findings) * score.training.rms), 12);
    text += tested ? fmt::format("{:.3f}\n", scaleOf(findings) * score.held_out.rms) : "\n";
  }
  text += findings.offsets == OffsetRule::kShared
              ? "  All recordings have one encoder zero, that of the training.\n"
              : "  Every recording, held out or not, has its own encoder zero: the mean of its residuals.\n";
  return text;
}

std::string heldOutTable(const DriveFindings& findings) {
  if (findings.held_out.empty()) return {};
  std::string text = padded(fmt::format("held out [{}]", unitOf(findings)), 32);
  for (const DriveModelScore& score : findings.scores) text += padded(score.key, 12);
  text += "\n";
  for (std::size_t file = 0; file < findings.held_out.size(); ++file) {
    text += padded(nameOf(findings.held_out[file]), 32);
    for (const DriveModelScore& score : findings.scores)
      text += padded(fmt::format("{:.3f}", scaleOf(findings) * score.held_out.file_rms[file]), 12);
    text += "\n";
  }
  return text;
}

nlohmann::json jsonOf(const DriveScore& score, const std::vector<std::string>& names) {
  nlohmann::json files = nlohmann::json::array();
  for (std::size_t i = 0; i < names.size(); ++i)
    files.push_back({{"file", names[i]}, {"rms", score.file_rms[i]}, {"offset", score.offset[i]}});
  return {{"rms", score.rms}, {"recordings", files}};
}

nlohmann::json jsonOf(const DriveEstimate& estimate) {
  return {{"name", estimate.parameter.name()},
          {"nominal", estimate.parameter.nominal},
          {"value", estimate.value()},
          {"sigma", estimate.valueSigma()},
          {"low", estimate.low()},
          {"high", estimate.high()},
          {"percent", estimate.percent()},
          {"seen", estimate.seen},
          {"advice", estimate.advice}};
}

nlohmann::json jsonOf(const Eigen::MatrixXd& matrix) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::VectorXd row = matrix.row(i);
    rows.push_back(std::vector<double>(row.data(), row.data() + row.size()));
  }
  return rows;
}

}  // namespace

std::string textOf(const DriveFindings& findings) {
  const auto& report = findings.report;
  std::string text = fmt::format(
      "drive: {} recordings with {} observations ({} after {} iterations).\n  {:.1f} % of the observations "
      "are "
      "down-weighted as outliers. Computing took {:.1f} s.\n  The residual is {:.2f} {}",
      findings.training.size(), report.observations, base::nameOf(report.end), report.iterations,
      100.0 * report.outliers, report.seconds, scaleOf(findings) * report.angle_noise, unitOf(findings));
  if (report.torque_noise > 0.0) text += fmt::format(" and {:.4f} N·m", report.torque_noise);
  text += ".";
  if (report.torque_sign < 0.0) text += " tau_m1 is the reaction of the drive, so its sign is inverted.";
  return text + "\n\n" + parameterTable(findings) + "\n" + offsetsText(findings) + "\n" +
         scoreTable(findings) + (findings.held_out.empty() ? "" : "\n") + heldOutTable(findings);
}

nlohmann::json jsonOf(const DriveFindings& findings) {
  const auto& report = findings.report;
  nlohmann::json parameters = nlohmann::json::array(), offsets = nlohmann::json::array(),
                 scores = nlohmann::json::object(), seen = nlohmann::json::array();
  for (const DriveEstimate& estimate : report.estimates) {
    parameters.push_back(jsonOf(estimate));
    if (estimate.seen) seen.push_back(estimate.parameter.name());
  }
  for (const auto& offset : report.offsets)
    offsets.push_back({{"recording", offset.title}, {"value", offset.value}, {"sigma", offset.sigma}});
  for (const DriveModelScore& score : findings.scores) {
    scores[score.key]["training"] = jsonOf(score.training, findings.training);
    if (!findings.held_out.empty()) scores[score.key]["held_out"] = jsonOf(score.held_out, findings.held_out);
  }
  return {{"end", base::nameOf(report.end)},
          {"offset_rule", base::nameOf(findings.offsets)},
          {"parameters", parameters},
          {"seen", seen},
          {"covariance_of_logarithms", jsonOf(report.covariance)},
          {"correlation", jsonOf(report.correlation)},
          {"offsets", offsets},
          {"offset_by_load", report.offset_by_load},
          {"offset_load_correlation", report.offset_load_correlation},
          {"gear", {{"gain", findings.gear.gain}, {"offset", findings.gear.offset}}},
          {"stretch",
           {{"gain", findings.stretch.gain},
            {"compliance", findings.stretch.compliance},
            {"offset", findings.stretch.offset}}},
          {"scores", scores},
          {"torque_sign", report.torque_sign},
          {"angle_noise", report.angle_noise},
          {"torque_noise", report.torque_noise},
          {"outliers", report.outliers},
          {"observations", report.observations},
          {"iterations", report.iterations},
          {"seconds", report.seconds}};
}

}  // namespace capstan::cli
