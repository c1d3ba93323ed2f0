#pragma once

#include <string>
#include <vector>

#include "core/tracking/source.h"

namespace capstan::tracking {

/// Whether a person has to act: a side of a live source is silent, was refused, has ended, or waits
/// again.
bool needsAttention(const SideStatus& side);
/// What is concerned, its state, and after `how_long` why: "right camera silent for 3.0 s: no server answers
/// there".
std::string stateOf(const SideStatus& side, const std::string& how_long = {});
/// A few words for a status line, as "motors silent for 2.1 s"; empty while all is well.
std::string shortTextOf(const SideStatus& side);
/// Why joint encoders are not used (their stamps differ from those of the motors, or they come too late), and
/// the remedy; empty: they are used.
std::string encodersText(const SideStatus& side);
/// State of a camera ("left", "right") from which no new image comes, "silent for 3 s"; empty: its newest
/// image is of now, or none has come.
std::string outdatedText(const std::vector<SideStatus>& sides, const std::string& camera);
/// One line with all that is known: counts, clock, delay.
std::string textOf(const SideStatus& side);

}  // namespace capstan::tracking
