#pragma once

#include <QTimer>
#include <QWidget>
#include <array>
#include <memory>

#include "core/live/live_preview.h"

class QLabel;

namespace capstan::widgets {

/// Newest images and motor positions of a robot, and what its sides say.
class LivePreviewView : public QWidget {
  Q_OBJECT

 public:
  explicit LivePreviewView(QWidget* parent = nullptr);
  ~LivePreviewView() override;

  void start(const live::LiveSetup& setup);
  /// Frees the robot's ports and devices.
  void stop();

 private:
  void refresh();

  std::unique_ptr<live::LivePreview> preview_;
  bool cameras_ = true;  ///< the set-up of preview_ has cameras
  QTimer timer_;
  std::array<QLabel*, 2> images_;
  std::array<QLabel*, 3> motors_;
  QLabel* sides_;
};

}  // namespace capstan::widgets
