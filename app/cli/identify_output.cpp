#include "app/cli/identify_output.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "app/cli/console.h"
#include "core/base/units.h"
#include "core/experiments/identified.h"
#include "core/identification/estimate_text.h"

namespace capstan::cli {
namespace {

using identification::BatchReport;
using identification::DualUkfReport;
using identification::Estimate;

std::string cell(const Estimate& estimate) {
  if (!estimate.seen) return "not observable";
  const double scale = estimate.parameter.scale();
  return fmt::format("{:.5g} ± {:.2g}", scale * estimate.value(), scale * estimate.valueSigma());
}

std::string changeOf(const Estimate& estimate) {
  return estimate.seen ? fmt::format("{:+.2f} %", estimate.percent()) : std::string("—");
}

/// `text` padded with spaces to `width` characters (not bytes).
std::string padded(const std::string& text, std::size_t width) {
  std::size_t characters = 0;
  for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  return text + std::string(width > characters ? width - characters : 0, ' ');
}

std::string table(const std::vector<std::pair<std::string, const std::vector<Estimate>*>>& methods,
                  const TrueValues& truth) {
  constexpr std::size_t kName = 16, kNumber = 12, kCell = 24, kChange = 12;
  std::string text = padded("parameter", kName) + padded("nominal", kNumber);
  if (!truth.empty()) text += padded("truth", kNumber);
  for (const auto& [name, estimates] : methods) text += padded(name, kCell) + padded("change", kChange);
  text += "\n";
  const std::vector<Estimate>& first = *methods.front().second;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto& parameter = first[i].parameter;
    text += padded(parameter.name() + " [" + parameter.unit() + "]", kName) +
            padded(fmt::format("{:.5g}", parameter.scale() * parameter.nominal), kNumber);
    if (!truth.empty()) text += padded(fmt::format("{:.5g}", parameter.scale() * truth[i]), kNumber);
    for (const auto& [name, estimates] : methods)
      text += padded(cell((*estimates)[i]), kCell) + padded(changeOf((*estimates)[i]), kChange);
    text += "\n";
  }
  return text;
}

/// `words` behind `begin`, wrapped at spaces to the width of a terminal; further lines begin with `indent`.
std::string wrapped(const std::string& begin, const std::string& words, const std::string& indent) {
  constexpr std::size_t kWidth = 100;
  std::string text, line = begin;
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    if (line.size() + 1 + word.size() > kWidth) {
      text += line + "\n";
      line = indent;
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + "\n";
}

/// Text "  name: words".
std::string said(const std::string& name, const std::string& words) {
  return wrapped("  " + name + ":", words, "     ");
}

/// `text` without its numbers, to compare two texts.
std::string withoutNumbers(std::string text) {
  std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; });
  return text;
}

/// Advice of all estimates, one paragraph per parameter. Advice that differs from that of the dual UKF only
/// in its numbers is replaced by "not observable, as above".
std::string advice(const std::vector<Estimate>& estimates, const DualUkfReport* dual) {
  std::string text;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& estimate = estimates[i];
    if (estimate.advice.empty()) continue;
    const bool again = !estimate.seen && dual && i < dual->estimates.size() && !dual->estimates[i].seen &&
                       withoutNumbers(dual->estimates[i].advice) == withoutNumbers(estimate.advice);
    text += said(estimate.parameter.name(), again ? "not observable, as above" : estimate.advice);
  }
  return text;
}

/// "+0.12 ± 0.03, -0.10 ± 0.03, +0.01 ± 0.05" of x, y, z.
std::string axesText(const Eigen::Vector3d& value, const Eigen::Vector3d& sigma) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += fmt::format("{}{:+.2f} ± {:.2f}", i > 0 ? ", " : "", value(i), sigma(i));
  return text;
}

std::string poseText(const identification::CameraPose& pose, const identification::CameraPose& sigma) {
  constexpr double kDegrees = base::toDegrees(1.0), kMillimetres = base::toMillimetres(1.0);
  return "  The cameras differ from their registration by\n" +
         fmt::format("    rotation (x, y, z) {} deg\n",
                     axesText(kDegrees * pose.rotation, kDegrees * sigma.rotation)) +
         fmt::format("    translation (x, y, z) {} mm\n",
                     axesText(kMillimetres * pose.shift, kMillimetres * sigma.shift)) +
         fmt::format("    delay of the time stamps {:+.1f} ± {:.1f} ms\n", 1e3 * pose.delay,
                     1e3 * sigma.delay);
}

std::string dualText(const DualUkfReport& report) {
  if (report.estimates.empty()) return fmt::format("dual UKF: no result ({}).\n", base::nameOf(report.end));
  std::string text = wrapped(
      "dual UKF:",
      fmt::format("{:.0f} s of data with {} camera observations ({}). NIS / 3 is {:.2f}; 1 is consistent. "
                  "{:.1f} % of the observations are down-weighted as outliers. Computing took {:.1f} s.",
                  report.used, report.observations, base::nameOf(report.end), report.nis,
                  100.0 * report.outliers, report.seconds),
      " ");
  for (std::size_t i = 0; i < report.estimates.size(); ++i)
    text += said(report.estimates[i].parameter.name(),
                 experiments::progressWords(report.convergence[i], report.estimates[i]));
  return text + poseText(report.camera, report.camera_sigma);
}

std::string batchText(const BatchReport& report, const DualUkfReport* dual) {
  if (report.estimates.empty()) return fmt::format("batch: no result ({}).\n", base::nameOf(report.end));
  return wrapped("batch:",
                 fmt::format(
                     "{} camera observations ({} after {} iterations). The RMS residual is {:.2f} σ with "
                     "the nominal values and {:.2f} σ with the identified ones; 1 is noise alone. {:.1f} "
                     "% of the observations are down-weighted as outliers. Computing took {:.1f} s.",
                     report.observations, base::nameOf(report.end), report.iterations, report.residual_before,
                     report.residual_after, 100.0 * report.outliers, report.seconds),
                 " ") +
         advice(report.estimates, dual) + poseText(report.camera, report.camera_sigma);
}

nlohmann::json estimatesJson(const std::vector<Estimate>& estimates, const TrueValues& truth) {
  nlohmann::json all = nlohmann::json::array();
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const Estimate& estimate = estimates[i];
    nlohmann::json one = {{"name", estimate.parameter.name()}, {"nominal", estimate.parameter.nominal},
                          {"value", estimate.value()},         {"sigma", estimate.valueSigma()},
                          {"low95", estimate.low()},           {"high95", estimate.high()},
                          {"percent", estimate.percent()},     {"seen", estimate.seen},
                          {"advice", estimate.advice}};
    if (!truth.empty()) one["truth"] = truth[i];
    all.push_back(one);
  }
  return all;
}

nlohmann::json matrixJson(const Eigen::MatrixXd& matrix) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    nlohmann::json row = nlohmann::json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

nlohmann::json poseJson(const identification::CameraPose& pose) {
  return {{"rotation", toJson(pose.rotation)}, {"shift", toJson(pose.shift)}, {"delay", pose.delay}};
}

}  // namespace

std::string textOf(const DualUkfReport* dual, const BatchReport* batch, const TrueValues& truth) {
  std::vector<std::pair<std::string, const std::vector<Estimate>*>> methods;
  if (dual && !dual->estimates.empty()) methods.emplace_back("dual UKF", &dual->estimates);
  if (batch && !batch->estimates.empty()) methods.emplace_back("batch", &batch->estimates);
  std::string text = methods.empty() ? std::string() : table(methods, truth) + "\n";
  if (dual) text += dualText(*dual);
  if (batch) text += batchText(*batch, dual);
  return text;
}

std::string identifiedParagraph(const std::vector<Estimate>& estimates) {
  return wrapped("", identification::identifiedText(estimates), "");
}

nlohmann::json jsonOf(const DualUkfReport& report, const TrueValues& truth) {
  nlohmann::json document = {{"end", base::keyOf(report.end)},
                             {"parameters", estimatesJson(report.estimates, truth)},
                             {"correlation", matrixJson(report.correlation)},
                             {"camera", poseJson(report.camera)},
                             {"camera_sigma", poseJson(report.camera_sigma)},
                             {"nis", report.nis},
                             {"observations", report.observations},
                             {"used", report.used},
                             {"outliers", report.outliers},
                             {"rescues", report.rescues}};
  for (std::size_t i = 0; i < report.convergence.size(); ++i) {
    const auto& convergence = report.convergence[i];
    nlohmann::json& one = document["parameters"][i];
    one["settled"] = convergence.settled;
    one["settled_at"] = convergence.settled_at ? nlohmann::json(*convergence.settled_at) : nlohmann::json();
    one["time_needed"] =
        convergence.time_needed ? nlohmann::json(*convergence.time_needed) : nlohmann::json();
  }
  return document;
}

nlohmann::json jsonOf(const BatchReport& report, const TrueValues& truth) {
  return {{"end", base::keyOf(report.end)},
          {"parameters", estimatesJson(report.estimates, truth)},
          {"covariance_log", matrixJson(report.covariance)},
          {"correlation", matrixJson(report.correlation)},
          {"camera", poseJson(report.camera)},
          {"camera_sigma", poseJson(report.camera_sigma)},
          {"singular_values", matrixJson(report.before.singular_values)},
          {"residual_before", report.residual_before},
          {"residual_after", report.residual_after},
          {"observations", report.observations},
          {"iterations", report.iterations},
          {"outliers", report.outliers}};
}

void writeTrace(const DualUkfReport& report, const identification::ParameterSet& set,
                const std::filesystem::path& path) {
  std::ofstream file(path);
  file << "t";
  for (const auto& parameter : set.all()) file << ',' << parameter.name() << ",sigma_" << parameter.name();
  file << '\n';
  for (const auto& point : report.trace) {
    file << fmt::format("{:.17g}", point.t);
    for (int i = 0; i < set.size(); ++i) {
      const double value = set.value(i, point.log(i));
      file << fmt::format(",{:.17g},{:.17g}", value, value * point.sigma(i));
    }
    file << '\n';
  }
  if (!file.flush())
    refuseFile(path.string(), "cannot be written", "Choose a folder that exists and has room");
}

}  // namespace capstan::cli
