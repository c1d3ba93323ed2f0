#pragma once

#include <QWidget>

#include "core/registration/registration_guide.h"
#include "widgets/figures/theme.h"

class QCPGraph;
class QCPItemText;
class QCPItemEllipse;
class QCPItemLine;
class QCustomPlot;

namespace capstan::widgets {

/// Triangulated points relative to their median in camera axes [mm]: x–y with its 2σ ellipse, and z against
/// the frame number. Rejected points are crosses in the fault colour.
class ScatterPlot : public QWidget {
  Q_OBJECT

 public:
  explicit ScatterPlot(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showGuide(const registration::RegistrationGuide& guide);
  /// Number of points drawn as used, and as rejected; for tests.
  int usedShown() const;
  int outliersShown() const;
  QCustomPlot& across() { return *across_; }
  QSize minimumSizeHint() const override { return {320, 190}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void scaleAcross();

  QCustomPlot* across_;  // x–y
  QCustomPlot* depth_;   // z against the frame number
  QCPGraph *used_, *rejected_, *depth_used_, *depth_rejected_;
  QCPItemEllipse* ellipse_;
  QCPItemLine *depth_low_, *depth_high_;
  double reach_ = 0.5;  // [mm] half of the shorter side
  int depth_frames_ = 60;
};

}  // namespace capstan::widgets
