#include "widgets/scene/orbit_mouse.h"

#include <QMouseEvent>
#include <QWheelEvent>
#include <cmath>

namespace capstan::widgets {

bool OrbitMouse::press(const QMouseEvent& event) {
  dragging_ = event.button() == Qt::LeftButton || event.button() == Qt::MiddleButton;
  last_ = event.pos();
  return dragging_;
}

bool OrbitMouse::move(const QMouseEvent& event, OrbitCamera& camera, int height) {
  if (!dragging_) return false;
  const QPoint by = event.pos() - last_;
  last_ = event.pos();
  const bool pan = (event.buttons() & Qt::MiddleButton) || (event.modifiers() & Qt::ShiftModifier);
  if (pan)
    camera.pan(-static_cast<double>(by.x()) / height, static_cast<double>(by.y()) / height);
  else
    camera.orbit(-0.008 * by.x(), 0.008 * by.y());
  return true;
}

void OrbitMouse::wheel(QWheelEvent& event, OrbitCamera& camera) {
  camera.zoom(std::pow(0.999, event.angleDelta().y()));
  event.accept();
}

}  // namespace capstan::widgets
