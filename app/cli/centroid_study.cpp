#include "app/cli/centroid_study.h"

#include <fmt/format.h>

#include <numeric>

#include "core/stats/quantile.h"

namespace capstan::cli {
namespace {

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::nan("") : static_cast<double>(part) / static_cast<double>(whole);
}

double meanOf(const std::vector<double>& values) {
  return values.empty()
             ? std::nan("")
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

constexpr double kTick = 1e-3;  // period of the motor samples, at which cameras are blocked and freed [s]

}  // namespace

bool CentroidStudy::blockedAt(double exposed) const {
  return occlusion_.blockedAt(exposed) || occlusion_.blockedAt(exposed - kTick);
}

void CentroidStudy::add(const tracking::Snapshot& snapshot) {
  if (!snapshot.camera_updated || !snapshot.camera_images) return;
  const simulation::FrameTruth& truth = source_.frameTruth();
  if (blockedAt(truth.t)) return;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto& rendered = truth.marker[side];
    if (!rendered.in_view) continue;
    ++in_view_;
    if (!snapshot.marker[side].found()) continue;
    ++detected_;
    const double error = (snapshot.marker[side].centroid - rendered.ellipse_centre).norm();
    if (error > rendered.radius)
      ++strangers_;
    else
      errors_.push_back(error);
  }
}

std::string CentroidStudy::text() const {
  std::string text = fmt::format(
      "images         {} with the whole marker in view, detected {:.2f} %; {} detections are other objects\n",
      in_view_, 100.0 * share(detected_, in_view_), strangers_);
  if (!errors_.empty())
    text += fmt::format("centroid error mean {:.4f} px, 95 % below {:.4f} px\n", meanOf(errors_),
                        stats::quantile(errors_, 0.95));
  return text;
}

nlohmann::json CentroidStudy::json() const {
  return {{"in_view", in_view_},
          {"detected", detected_},
          {"other_objects", strangers_},
          {"mean_px", meanOf(errors_)},
          {"p95_px", stats::quantile(errors_, 0.95)}};
}

}  // namespace capstan::cli
