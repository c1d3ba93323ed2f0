#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <functional>

#include "widgets/scene/orbit_camera.h"
#include "widgets/scene/orbit_mouse.h"

namespace capstan::widgets {

/// A view whose image the RenderThread draws: at most 15 per second, one at a time, and only after a change.
/// Left drag orbits, middle or shift drag pans, the wheel zooms, a double click resets the camera.
///
/// A derived class owns the renderer. It changes it in tasks of the RenderThread only, and its destructor
/// waits for them with RenderThread::run().
class RenderedView : public QWidget {
 public:
  explicit RenderedView(QWidget* parent = nullptr);

  /// Whether VTK can draw here: it needs an X display and crashes without one.
  static bool available();

  OrbitCamera& camera() { return camera_; }
  virtual void resetCamera() = 0;
  /// Draws now and returns the image, without labels. For tests and exports.
  QImage image();

 protected:
  /// Draws as the camera sees it; `size` [px]. Runs in the RenderThread.
  using Drawing = std::function<QImage(const OrbitCamera& camera, const QSize& size)>;
  /// The drawing of what is known now; empty: there is nothing to draw.
  virtual Drawing drawing() = 0;

  void changed();
  /// Discards the image and the drawings that are queued.
  void clear();

  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

  OrbitCamera camera_;
  QImage image_;
  OrbitCamera image_camera_;  ///< from which image_ was drawn: its labels fit it

 private:
  void draw();
  void take(const QImage& image, const OrbitCamera& camera);
  QSize pixels() const;

  QTimer timer_;
  OrbitMouse mouse_;
  bool changed_ = true, drawing_ = false;
  int cleared_ = 0;  ///< number of calls of clear()
};

}  // namespace capstan::widgets
