#pragma once

#include <QWidget>
#include <array>
#include <opencv2/core/mat.hpp>

#include "core/registration/registration_guide.h"
#include "core/robot/arm_kinematics.h"
#include "core/tracking/snapshot.h"
#include "core/vision/camera.h"
#include "widgets/figures/theme.h"

class QComboBox;
class QLabel;
class QPushButton;

namespace capstan::widgets {

class StereoView;

/// Step 3: the new translation with its ±, the change by it, and the arm as projected over the images by the
/// old and the new registration. Accept, redo, or reject with a reason.
class ResultPage : public QWidget {
  Q_OBJECT

 public:
  explicit ResultPage(QWidget* parent = nullptr);
  ~ResultPage() override;
  void setTheme(const Theme& theme);
  void setRig(const robot::Description& robot, const std::optional<vision::StereoRig>& rig);
  void showGuide(const registration::RegistrationGuide& guide);
  /// Sets whether the session has ended, so that nothing can be collected again.
  void setEnded(bool ended);
  void showFrames(const cv::Mat& left, const cv::Mat& right, const tracking::Snapshot& snapshot);
  StereoView& pictures() { return *frames_; }
  QString summary() const;

 signals:
  void acceptRequested();
  void redoRequested();
  void rejectRequested(const QString& reason);

 private:
  void overlay(const registration::RegistrationGuide& guide, const Eigen::Vector3d& q);

  Theme theme_ = Theme::dark();
  std::optional<robot::ArmKinematics> arm_;
  std::optional<vision::StereoRig> rig_;
  double marker_radius_ = 0.0;
  std::optional<Eigen::Isometry3d> old_, new_;
  QLabel* numbers_;
  QLabel* note_;
  StereoView* frames_;
  QComboBox* reason_;
  QPushButton *accept_, *redo_, *reject_;
};

}  // namespace capstan::widgets
