#include "app/monitor/banner.h"

#include <fmt/format.h>

#include <cmath>

namespace capstan::monitor {

using Link = live::FeedReader::Link;
using live::FeedImage;
using live::FeedRun;
using live::FeedTracking;

namespace {

constexpr double kLongSilence = 1.0;  // [s]
constexpr float kDimmed = 0.4F;

std::string seconds(double time) { return fmt::format("{:.{}f} s", time, time < 10.0 ? 1 : 0); }

/// 2 sigma of the tip in the least certain direction [mm].
std::string tipSpread(const live::FeedState& state) {
  double variance = 0.0;
  for (const double sigma : state.tip_sigma) variance += sigma * sigma;
  return std::isfinite(variance) ? fmt::format("tip ± {:.1f} mm (2σ)", 2e3 * std::sqrt(variance))
                                 : std::string();
}

void add(std::string& text, const std::string& more) {
  if (more.empty()) return;
  text += (text.empty() ? "" : " · ") + more;
}

Banner tracked(const live::FeedState& state) {
  Banner banner;
  banner.colour = kWarning;
  add(banner.detail, std::string(live::textOf(state.words)));
  switch (state.tracking) {
    case FeedTracking::kTracking:
      banner.word = "TRACKING";
      banner.colour = state.motor_fault ? kWarning : kUkf;
      banner.estimate = kUkf;
      banner.certain = true;
      break;
    case FeedTracking::kOccluded:
      banner.word = "OCCLUDED";
      break;
    case FeedTracking::kRejected:
      banner.word = "CAMERA REJECTED";
      break;
    case FeedTracking::kNoCamera:
      banner.word = "NO CAMERA";
      break;
    case FeedTracking::kUnregistered:
      banner.word = "NOT REGISTERED";
      banner.detail = "the cameras' pose is unknown";
      banner.colour = kFault;
      return banner;
  }
  if (!banner.certain && state.uncertain_for > 0.0) banner.word += " " + seconds(state.uncertain_for);
  add(banner.detail, tipSpread(state));
  return banner;
}

}  // namespace

Banner bannerOf(Link link, FeedRun run, const std::string& fault, const live::FeedState& state,
                double silent_for, double images_for) {
  if (link == Link::kWaiting) return {"WAITING", "no session yet", kQuiet, kWarning, false, kDimmed};
  if (link == Link::kRefused) return {"REFUSED", fault, kFault, kWarning, false, kDimmed};
  if (link == Link::kEnded)
    return {"SESSION ENDED", "waiting for the next one", kFault, kWarning, false, kDimmed};
  if (state.number == 0) return {"WAITING", "the session has no data yet", kQuiet, kWarning, false, kDimmed};
  Banner banner = tracked(state);
  if (run == FeedRun::kPaused)
    return {"PAUSED", banner.detail, kQuiet, banner.estimate, banner.certain, 1.0F};
  if (run == FeedRun::kEnded)
    return {"END OF RECORDING", banner.detail, kQuiet, banner.estimate, banner.certain, 1.0F};
  if (silent_for > kLongSilence)
    return {"NO DATA " + seconds(silent_for),
            "the session runs, its source is silent",
            kFault,
            kWarning,
            false,
            kDimmed};
  const bool images = state.eyes[0].image != FeedImage::kNone || state.eyes[1].image != FeedImage::kNone;
  if (images && images_for > kLongSilence) {
    banner.word = "NO IMAGES " + seconds(images_for);
    banner.colour = kFault;
    banner.light = kDimmed;
  }
  return banner;
}

}  // namespace capstan::monitor
