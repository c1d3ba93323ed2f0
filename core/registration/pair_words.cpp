#include "core/registration/pair_words.h"

#include <fmt/format.h>

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
    case PairFault::kTooClose:
      return {fmt::format("{}: the rotation is uncertain by {:.1f}°", reason, base::toDegrees(refusal.value)),
              "Add poses farther apart"};
  }
  return {reason, {}};
}

}  // namespace capstan::registration
