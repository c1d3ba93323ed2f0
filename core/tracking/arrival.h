#pragma once

#include <variant>

#include "core/tracking/sample.h"

namespace capstan::tracking {

/// Time at which `sample` reaches the computer [s].
inline double arrivalOf(const tracking::Sample& sample) {
  if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) return frame->t_arrival;
  if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) return tip->t_arrival;
  if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) return joint->t;
  return std::get<tracking::MotorSample>(sample).t;
}

/// True for images and for tips that another system measured.
inline bool fromCamera(const tracking::Sample& sample) {
  return std::holds_alternative<tracking::StereoFrame>(sample) ||
         std::holds_alternative<tracking::TipSample>(sample);
}

}  // namespace capstan::tracking
