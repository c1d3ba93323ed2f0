#pragma once

#include <QColor>
#include <cstddef>

#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// What the newest image of a camera shows of the marker.
enum class MarkerSight { kNoImage, kLost, kSeen };

inline MarkerSight sightOf(const tracking::Snapshot& snapshot, std::size_t side) {
  if (!snapshot.camera_images) return MarkerSight::kNoImage;
  return snapshot.marker[side].found() ? MarkerSight::kSeen : MarkerSight::kLost;
}

inline QColor colourOf(MarkerSight sight, const Theme& theme) {
  if (sight == MarkerSight::kNoImage) return theme.muted;
  return sight == MarkerSight::kSeen ? theme.colour(Quantity::kCamera) : theme.warning;
}

}  // namespace capstan::widgets
