#pragma once

#include <QColor>
#include <cstddef>

#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// What the newest image of a camera shows of the marker.
enum class MarkerVisibility { kNoImage, kLost, kSeen };

inline MarkerVisibility visibilityOf(const tracking::Snapshot& snapshot, std::size_t side) {
  if (!snapshot.camera_images) return MarkerVisibility::kNoImage;
  return snapshot.marker[side].found() ? MarkerVisibility::kSeen : MarkerVisibility::kLost;
}

inline QColor colourOf(MarkerVisibility visibility, const Theme& theme) {
  if (visibility == MarkerVisibility::kNoImage) return theme.muted;
  return visibility == MarkerVisibility::kSeen ? theme.colour(Quantity::kCamera) : theme.warning;
}

}  // namespace capstan::widgets
