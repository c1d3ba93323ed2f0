#pragma once

#include <cstddef>

/// How far searchSets() goes: sizes of its beam and of its expansions, and gains for which it goes on.
namespace capstan::diagnosis::limits {

/// Sets that are expanded at a time; the same far from an explanation (RMS of a residual above kFar × noise).
inline constexpr std::size_t kBeam = 2, kFarBeam = 4;
inline constexpr double kFar = 2.0;
/// Largest number of sets near the best one that are settled together.
inline constexpr std::size_t kContenders = 8;
/// Trials of an expansion that are fitted to the end; the same where a neighbour of the best set is expanded.
inline constexpr std::size_t kSettled = 5, kNeighbourSettled = 2;
/// Short fits of an expansion of a neighbour.
inline constexpr int kNeighbourRefits = 4;
/// Trials of an expansion that are also fitted from the nominal parameters.
inline constexpr std::size_t kRestarts = 2;
/// Candidates that are fitted from the nominal parameters because they score best there.
inline constexpr std::size_t kFromNominal = 4;
/// Short fits of the best set in other forms that are fitted to the end.
inline constexpr std::size_t kOtherForms = 2;
/// Share of the best trial's gain, and of a loss to be made up, that is pursued.
inline constexpr double kHopeful = 0.5;
/// A set that is further below the best one is not expanded: odds of 1000 [nats].
inline constexpr double kWindow = 7.0;
/// A set that is further below the best one is not settled, since its posterior is of no interest: odds
/// of 20.
inline constexpr double kContend = 3.0;
/// Loss after a short fit that no fit to the end makes up [nats].
inline constexpr double kWorthMuch = 100.0;
/// Gain of another start for which the search goes on [nats].
inline constexpr double kRestart = 0.5;

}  // namespace capstan::diagnosis::limits
