#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <array>
#include <memory>

#include "core/registration/camera_checks.h"
#include "widgets/figures/theme.h"

class QLabel;
class QPushButton;

namespace capstan::widgets {

/// Histogram of the brightness of one image; clipped levels in the colour of faults.
class BrightnessView : public QWidget {
  Q_OBJECT

 public:
  explicit BrightnessView(const QString& name, QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showExposure(const vision::Exposure& exposure);
  QSize sizeHint() const override { return {112, 40}; }
  QSize minimumSizeHint() const override { return {80, 36}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Theme theme_ = Theme::dark();
  QString name_;
  vision::Exposure exposure_;
};

/// Live checks of both cameras (registration::CameraChecks): a mark and a number each, the remedy of what
/// fails, and a button where the program can do it.
class CameraStrip : public QWidget {
  Q_OBJECT

 public:
  explicit CameraStrip(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Starts again for the images of a source. Without a rig there are no images: nothing is shown.
  void begin(const std::optional<vision::StereoRig>& rig, const vision::MarkerOptions& marker);
  void setMarker(const vision::MarkerOptions& marker);
  /// Takes a pair of images; at most ten a second are judged.
  void see(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot);
  void observe(const tracking::Snapshot& snapshot);
  void setNow(double t, const std::vector<tracking::SideStatus>& sides);

  const registration::CameraChecks* checks() const { return checks_.get(); }
  /// "✓ focus 0.9, 1.1 px" of a check by its name.
  QString text(const QString& name) const;
  QString remedies() const;

 signals:
  void remedyRequested(const capstan::registration::CameraRemedy& remedy);

 private:
  void refresh();

  static constexpr std::size_t kChecks = 6;
  Theme theme_ = Theme::dark();
  std::unique_ptr<registration::CameraChecks> checks_;
  std::vector<registration::CameraCheck> shown_;
  std::array<QLabel*, kChecks> labels_{};
  std::array<BrightnessView*, 2> brightness_{};
  QWidget* notice_;
  QLabel* remedies_;
  QPushButton* button_;
  QElapsedTimer seen_, refreshed_;
};

}  // namespace capstan::widgets
