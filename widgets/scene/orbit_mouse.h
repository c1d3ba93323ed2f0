#pragma once

#include <QPoint>

#include "widgets/scene/orbit_camera.h"

class QMouseEvent;
class QWheelEvent;

namespace capstan::widgets {

/// Moves a camera by the mouse: left drag orbits, middle or shift drag pans, the wheel zooms.
class OrbitMouse {
 public:
  /// Handles a press; returns true if a drag begins.
  bool press(const QMouseEvent& event);
  /// Handles a move in a view of `height` [px]; returns true if the camera has moved.
  bool move(const QMouseEvent& event, OrbitCamera& camera, int height);
  void release() { dragging_ = false; }
  static void wheel(QWheelEvent& event, OrbitCamera& camera);

 private:
  bool dragging_ = false;
  QPoint last_;
};

}  // namespace capstan::widgets
