#pragma once

#include "core/diagnosis/hypotheses/hypothesis.h"

/// The hypotheses one by one, each in the file of its name; hypotheses() lists them. A new one has its facts
/// in core/robot/effects.cpp, its law in core/robot/chain/chain_law.h, and its file, its line here and its
/// line in hypotheses.cpp.
namespace capstan::diagnosis::library {

const Hypothesis& pulleyRadius();
const Hypothesis& cableCoupling();
const Hypothesis& homingOffset();
const Hypothesis& encoderSlip();
const Hypothesis& capstanEccentricity();
const Hypothesis& cableCompliance();
const Hypothesis& cableStiffening();
const Hypothesis& positionStiffness();
const Hypothesis& backlash();
const Hypothesis& slack();
const Hypothesis& cableHysteresis();
const Hypothesis& cableCreep();
const Hypothesis& stribeckFriction();
const Hypothesis& asymmetricFriction();
const Hypothesis& asymmetricViscosity();
const Hypothesis& viscousFriction();
const Hypothesis& loadFriction();
const Hypothesis& positionFriction();
const Hypothesis& gravityTilt();
const Hypothesis& payload();
const Hypothesis& inertia();
const Hypothesis& actuatorGain();
const Hypothesis& torqueOffset();
const Hypothesis& cameraLatency();
const Hypothesis& cameraRotation();
const Hypothesis& cameraOffset();
const Hypothesis& cameraScale();
const Hypothesis& sensorSign();

}  // namespace capstan::diagnosis::library
