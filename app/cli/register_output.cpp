#include "app/cli/register_output.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <numeric>

#include "app/cli/console.h"
#include "core/registration/pair_words.h"

namespace capstan::cli {

Registered registerRows(std::vector<registration::PairRow> rows,
                        const std::optional<vision::Triangulator>& triangulator, bool exchange,
                        const std::string& file) {
  const bool pixels = std::ranges::any_of(rows, [](const auto& row) { return row.pixels.has_value(); });
  if (pixels && !triangulator)
    refuseFile(file, "pixels need the calibrated cameras", "Give --cameras FOLDER");
  if (exchange) rows = registration::exchanged(std::move(rows));
  auto points = registration::pointsOf(rows, triangulator);
  const auto fit = registration::registerPairs(points.pairs);
  if (fit) return {std::move(points), rows.size(), *fit};
  if (pixels && registration::areExchanged(rows, *triangulator))
    refuseFile(file, "the left and the right pixels are exchanged",
               exchange ? "Leave out --exchange" : "Give --exchange, or exchange the columns");
  if (!points.skipped.empty() && 2 * points.pairs.size() < rows.size())
    refuseFile(
        file,
        fmt::format("{} of {} rows have no pair of points; row {}: {}", points.skipped.size(), rows.size(),
                    points.skipped.front().row, points.skipped.front().reason),
        "Add poses in which both cameras see the marker; check that the cameras' calibration is theirs");
  const auto [reason, remedy] = registration::wordsOf(fit.error());
  refuseFile(file, reason, remedy);
}

nlohmann::json documentOf(const Registered& found) {
  const auto& fit = found.fit;
  nlohmann::json rejected = nlohmann::json::array(), covariance = nlohmann::json::array();
  nlohmann::json residuals(found.rows, nullptr), shifts = residuals, skipped = nlohmann::json::array();
  for (std::size_t i = 0; i < fit.used.size(); ++i) {
    residuals[found.points.rows[i]] = fit.residuals[i];
    shifts[found.points.rows[i]] = fit.shifts[i];
    if (!fit.used[i]) rejected.push_back(found.points.rows[i]);
  }
  for (const auto& [row, reason] : found.points.skipped)
    skipped.push_back({{"row", row}, {"reason", reason}});
  for (int row = 0; row < 6; ++row) {
    const Eigen::Matrix<double, 1, 6> line = fit.covariance.row(row);
    covariance.push_back(std::vector<double>(line.data(), line.data() + 6));
  }
  return {{"base_from_camera", toJson(fit.base_from_camera)},
          {"rms", fit.rms},
          {"leave_one_out_rms", fit.leave_one_out_rms},
          {"sigma", fit.sigma},
          {"covariance", covariance},
          {"residuals", residuals},
          {"shifts", shifts},
          {"rows", found.rows},
          {"used", fit.used.size() - rejected.size()},
          {"rejected", rejected},
          {"skipped", skipped},
          {"warning", registration::warningOf(fit)}};
}

std::string residualTable(const Registered& found) {
  constexpr std::size_t kMost = 20, kLargest = 10;
  const auto& fit = found.fit;
  std::vector<std::size_t> order(fit.residuals.size());
  std::iota(order.begin(), order.end(), 0);
  const bool all = order.size() <= kMost;
  if (!all)
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return fit.residuals[i]; });
  std::string text = "   row   residual [mm]\n";
  for (std::size_t i = 0; i < (all ? order.size() : kLargest); ++i) {
    const std::size_t at = order[i];
    text += fmt::format("{:6}   {:13.3f}   {}\n", found.points.rows[at], 1e3 * fit.residuals[at],
                        fit.used[at] ? "used" : "rejected");
  }
  if (!all)
    text += fmt::format("These are the {} largest residuals. The other {} are {:.3f} mm or less.\n", kLargest,
                        order.size() - kLargest, 1e3 * fit.residuals[order[kLargest]]);
  return text;
}

}  // namespace capstan::cli
