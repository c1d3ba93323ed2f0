#pragma once

#include <QWidget>
#include <array>

#include "core/tracking/track_all.h"
#include "widgets/figures/theme.h"

class QLabel;
class QPushButton;

namespace capstan::widgets {

/// RMS errors of kinematics, camera and UKF against the joint encoders: one row per joint, in deg, deg, mm.
class ErrorsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ErrorsPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Shows the errors of a report, and below them over how many samples they are. Differences from the
  /// robot's own kinematics are called so.
  void showReport(const tracking::TrackReport& report);
  /// Sets whether the source has joint encoders, or else joint angles of its own; without them a note
  /// replaces the number of samples. Clears the errors.
  void setReference(bool fitted);
  /// The line below the errors.
  QString note() const;
  /// Shows the verdict on the estimator, as "✓ pass"; empty: none yet.
  void showVerdict(const QString& verdict);
  /// Text of a cell: `joint` 0…2, `column` 0 kinematic, 1 camera, 2 UKF.
  QString cell(int joint, int column) const;
  /// The table as text for the clipboard: one line per joint, separated by tabs.
  QString text() const;

 signals:
  void resetRequested();
  void healthRequested();

 private:
  std::array<std::array<QLabel*, 3>, 3> cells_{};
  std::array<QLabel*, 3> heads_{};
  std::array<QLabel*, 6> quiet_{};  ///< labels in the muted colour: joint names and units
  QLabel* note_;
  QPushButton *reset_, *health_;
  bool reference_ = true;
};

}  // namespace capstan::widgets
