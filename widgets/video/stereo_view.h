#pragma once

#include <QWidget>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"
#include "widgets/figures/theme.h"
#include "widgets/video/roi_view.h"

namespace capstan::widgets {

/// Left and right camera, one above the other, or side by side if the widget is wide.
class StereoView : public QWidget {
  Q_OBJECT

 public:
  explicit StereoView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Shows the images of one camera sample and the snapshot computed from it. Images are copied; for empty
  /// ones the reason is shown.
  void showFrames(const cv::Mat& left, const cv::Mat& right, const tracking::Snapshot& snapshot);
  /// For a source without images: shows `why` instead.
  void clear(const QString& why);
  void setLines(const std::array<std::vector<ImageLine>, 2>& lines);
  void setWholeFrameLarge(bool large);
  /// Marks the image of a camera from which no new one comes.
  void setOutdated(const std::vector<tracking::SideStatus>& sides);
  RoiView& left() { return *views_[0]; }
  RoiView& right() { return *views_[1]; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();

  std::array<RoiView*, 2> views_;
};

}  // namespace capstan::widgets
