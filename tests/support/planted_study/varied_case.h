#pragma once

#include "tests/support/planted_study/study_cases.h"

namespace capstan::study {

/// Options of a case of the varied population: robot, sensors, motion, duration (8–20 s; from four joints on
/// 8–12 s), and how far the robot differs from its file, all drawn from the seed of the case. Random
/// robots have as many joints as the effect needs.
/// Throws std::invalid_argument if the effect makes no sense on robots of this kind.
test::DrawOptions variedOptions(const StudyCase& one);

}  // namespace capstan::study
