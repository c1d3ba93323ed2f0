#pragma once

#include <QWidget>
#include <array>

#include "core/tracking/error_table.h"
#include "widgets/figures/theme.h"

class QLabel;
class QPushButton;

namespace capstan::widgets {

/// RMS against the joint encoders of kinematics, camera and UKF: one row a joint, in deg, deg, mm.
class ErrorsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ErrorsPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showErrors(const tracking::ErrorTable& errors);
  /// For a source without joint encoders: reports it in place of numbers.
  void setReference(bool fitted);
  /// Text of a cell: `joint` 0…2, `column` 0 kinematic, 1 camera, 2 UKF.
  QString cell(int joint, int column) const;
  /// The table as the clipboard takes it: a line a joint, tabs between.
  QString text() const;

 signals:
  void resetRequested();

 private:
  std::array<std::array<QLabel*, 3>, 3> cells_{};
  std::array<QLabel*, 3> heads_{};
  std::array<QLabel*, 6> quiet_{};  ///< joint names and units
  QLabel* note_;
  QPushButton* reset_;
  bool reference_ = true;
};

}  // namespace capstan::widgets
