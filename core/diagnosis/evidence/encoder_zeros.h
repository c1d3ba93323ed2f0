#pragma once

#include <array>
#include <utility>

#include "core/base/names.h"

namespace capstan::diagnosis {

/// What a fit assumes of the joint encoders' zeros. A free zero absorbs every residual that is constant over
/// the recordings that share this zero. One zero per recording therefore also absorbs the cable stretch under
/// a load that is constant within each recording; one zero for all recordings does not.
enum class EncoderZeros {
  kKnown,            ///< as in the robot file; a zero error is the effect homing_offset
  kOneForAll,        ///< unknown, and the same in all recordings
  kOnePerRecording,  ///< unknown in each of several recordings; known where there is only one
};

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::EncoderZeros> {
  using Z = capstan::diagnosis::EncoderZeros;
  static constexpr std::array value = {std::pair{Z::kKnown, "known"}, std::pair{Z::kOneForAll, "shared"},
                                       std::pair{Z::kOnePerRecording, "each"}};
};
