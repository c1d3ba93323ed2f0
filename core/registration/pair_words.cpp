#include "core/registration/pair_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.h"

namespace capstan::registration {

RefusalWords wordsOf(const PairRefusal& refusal) {
  const std::string reason(base::nameOf(refusal.fault));
  switch (refusal.fault) {
    case PairFault::kTooFewPairs:
      return {fmt::format("{} ({:.0f})", reason, refusal.value), "Add poses that span the workspace"};
    case PairFault::kCollinear:
      return {reason, "Add poses away from the line"};
    case PairFault::kMirrored:
      return {reason, "Check the sign of every axis, and whether left and right are exchanged"};
    case PairFault::kScale:
      return {fmt::format("{}: those of the base frame are {:.4g} times as long", reason, refusal.value),
              "Give both in metres; check the size of the calibration board's squares and the base line"};
    case PairFault::kNoAgreement:
      return {fmt::format("{} ({:.0f})", reason, refusal.value),
              "Check that each pair has the same instant and the same point of the tool in both frames"};
    case PairFault::kScatter:
      return {fmt::format("{}: by {:.2f} mm per axis", reason, base::toMillimetres(refusal.value)),
              "Add poses farther apart; check that each pair has the same instant and the same point of the "
              "tool in both frames"};
    case PairFault::kTooClose:
      return {fmt::format("{}: the rotation is uncertain by {:.1f}°", reason, base::toDegrees(refusal.value)),
              "Add poses farther apart"};
  }
  return {reason, {}};
}

std::string warningOf(const PairRegistration& registration) {
  constexpr std::size_t kFew = 12;  // pairs below which one outlier may pass
  const std::size_t pairs = registration.used.size();
  const auto rejected = static_cast<std::size_t>(std::ranges::count(registration.used, false));
  if (4 * rejected > pairs)
    return fmt::format(
        "{} of {} pairs disagree with the fit: if they are not wrong detections, the constants of the robot "
        "file are "
        "wrong. Identify them first",
        rejected, pairs);
  if (pairs < kFew)
    return fmt::format("{} pairs leave a wrong one hard to recognise; {} or more are better", pairs, kFew);
  return {};
}

}  // namespace capstan::registration
