#pragma once

#include <QTimer>
#include <QWidget>
#include <memory>

#include "widgets/figures/theme.h"
#include "widgets/scene/cloud_renderer.h"
#include "widgets/scene/orbit_mouse.h"

namespace capstan::widgets {

/// Point clouds over a grid in millimetres, with a key. Left drag orbits, middle or shift drag pans, the
/// wheel zooms, a double click resets the view; Home, plus and minus do the same from the keyboard. It draws
/// when something changed. Without a display it shows an error.
class CloudView : public QWidget {
  Q_OBJECT

 public:
  explicit CloudView(QWidget* parent = nullptr);
  ~CloudView() override;

  void setTheme(const Theme& theme);
  /// Sets the clouds and keeps the camera. The grid encloses the clouds with `framed`, shown or not.
  void setClouds(std::vector<PointCloud> clouds);
  const std::vector<PointCloud>& clouds() const { return clouds_; }
  /// Sets the text shown while there are no clouds.
  void setEmptyWords(const QString& words);
  OrbitCamera& camera() { return camera_; }
  void resetCamera();
  /// Draws now and returns the image of the clouds without labels. For tests and exports.
  QImage image();

  QSize sizeHint() const override { return {640, 420}; }
  QSize minimumSizeHint() const override { return {200, 150}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  bool empty() const;
  void changed();
  void draw();
  void render();  ///< in the RenderThread
  void drawKey(QPainter& painter) const;

  Theme theme_ = Theme::dark();
  std::unique_ptr<CloudRenderer> renderer_;
  std::vector<PointCloud> clouds_;
  WorkspaceGrid grid_;
  OrbitCamera camera_;
  OrbitMouse mouse_;
  QString empty_words_;
  QImage image_;
  QTimer timer_;
  bool clouds_changed_ = true, changed_ = true;
};

}  // namespace capstan::widgets
