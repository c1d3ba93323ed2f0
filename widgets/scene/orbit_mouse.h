#pragma once

#include <QPoint>

#include "widgets/scene/orbit_camera.h"

class QMouseEvent;
class QWheelEvent;

namespace capstan::widgets {

/// How a mouse moves a view: left drag orbits, middle or shift drag pans, the wheel zooms.
class OrbitMouse {
 public:
  /// True: a drag has begun.
  bool press(const QMouseEvent& event);
  /// In a view of `height` [px]. True: the camera has moved.
  bool move(const QMouseEvent& event, OrbitCamera& camera, int height);
  void release() { dragging_ = false; }
  static void wheel(QWheelEvent& event, OrbitCamera& camera);

 private:
  bool dragging_ = false;
  QPoint last_;
};

}  // namespace capstan::widgets
