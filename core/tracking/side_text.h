#pragma once

#include <string>

#include "core/tracking/source.h"

namespace capstan::tracking {

/// Whether a person has to act: a side of a live source is silent, was refused, or has ended.
bool needsAttention(const SideStatus& side);
/// What is concerned, its state, and after `how_long` why: "right camera silent for 3.0 s: no server answers
/// there".
std::string stateOf(const SideStatus& side, const std::string& how_long = {});
/// A few words for a status line, as "motors silent for 2.1 s"; empty while all is well.
std::string shortTextOf(const SideStatus& side);
/// One line with all that is known: counts, clock, delay.
std::string textOf(const SideStatus& side);

}  // namespace capstan::tracking
