#pragma once

#include <array>
#include <utility>

#include "core/base/names.h"

namespace capstan::diagnosis {

/// Prior standard deviations of joint encoders' zeros. A zero that is free takes with it whatever holds still
/// over what it is free for: one for each recording also takes the stretch under a load that is constant in
/// each, one for all recordings does not.
enum class EncoderZeros {
  kKnown,            ///< as in the robot file: an error is homing_offset's
  kOneForAll,        ///< unknown, the same in all recordings
  kOnePerRecording,  ///< unknown, where there are several recordings; known where there is one
};

}  // namespace capstan::diagnosis

template <>
struct capstan::base::NamesOf<capstan::diagnosis::EncoderZeros> {
  using Z = capstan::diagnosis::EncoderZeros;
  static constexpr std::array value = {std::pair{Z::kKnown, "known"}, std::pair{Z::kOneForAll, "shared"},
                                       std::pair{Z::kOnePerRecording, "each"}};
};
