#pragma once

#include <memory>
#include <vector>

#include "core/diagnosis/evidence/encoder_zeros.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::diagnosis {

/// Durations of the windows of a rigid drive [s]: its simulation starts again from the joint encoders after
/// each. Over a longer window smaller effects are visible, but where joints stick and slip the fit from
/// constants that are far off ends in one of many minima. Effects are therefore searched with the shortest
/// windows first.
inline constexpr double kHorizons[] = {0.15, 0.5};
/// Windows with which effects that leave more than noise are confirmed: a wrong effect can lower the residual
/// over short windows, but raises it over long ones. Effects that explain the recording down to noise
/// (mostByChance() in every channel) need no confirmation, and over long windows the noise of torques hides
/// them. An effect that is visible over long windows only is not found. It is also the only horizon for
/// recordings without joint encoders, because camera observations need time to determine the state at the
/// start of a window.
inline constexpr double kFarHorizon = 2.0;

/// Selection, and the data that it was fitted to.
struct SelectionWithData {
  std::unique_ptr<FitData> data;
  Selection selection;
};

/// For rigid drives with joint encoders: select() for each of kHorizons, started from the selection with the
/// one before. Then, unless the selected effects explain the recordings down to noise, they are confirmed
/// with kFarHorizon: if a selection among the hypotheses of these effects and their competitors finds other
/// effects, it is the result. Otherwise the result is the selection with the last of kHorizons, whose fits
/// are less chaotic. All other recordings: one select() with kFarHorizon; cable drives ignore it, because
/// they are simulated over whole recordings. If `progress` is cancelled, the result is the last selection
/// that was completed, or what the first one has found.
SelectionWithData selectOverHorizons(const std::vector<Evidence>& recordings,
                                     const robot::Description& nominal, const FitModel& base,
                                     EncoderZeros zeros, int threads, const SearchOptions& options,
                                     base::Progress* progress);

}  // namespace capstan::diagnosis
