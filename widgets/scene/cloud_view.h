#pragma once

#include <memory>

#include "widgets/figures/theme.h"
#include "widgets/scene/cloud_renderer.h"
#include "widgets/scene/rendered_view.h"

namespace capstan::widgets {

/// Point clouds over a grid in millimetres, with a key. Home, plus and minus do from the keyboard what the
/// mouse does. Without a display it shows an error.
class CloudView : public RenderedView {
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
  void resetCamera() override;

  QSize sizeHint() const override { return {640, 420}; }
  QSize minimumSizeHint() const override { return {200, 150}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  bool empty() const;
  Drawing drawing() override;
  void drawKey(QPainter& painter) const;

  Theme theme_ = Theme::dark();
  std::unique_ptr<CloudRenderer> renderer_;  ///< for the RenderThread only
  std::vector<PointCloud> clouds_;
  WorkspaceGrid grid_;
  QString empty_words_;
  bool clouds_changed_ = true;
};

}  // namespace capstan::widgets
