#pragma once

#include <QWidget>

#include "core/vision/calibration.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;

namespace capstan::widgets {

/// The board that is shown to the cameras: kind, size, squares and markers.
class BoardForm : public QWidget {
  Q_OBJECT

 public:
  explicit BoardForm(QWidget* parent = nullptr);
  vision::CalibrationOptions options() const;
  void setOptions(const vision::CalibrationOptions& options);

 signals:
  void changed();

 private:
  void showMarkerFields();

  QComboBox *kind_, *dictionary_;
  QSpinBox *columns_, *rows_;
  QDoubleSpinBox *square_, *marker_;
  QLabel *marker_label_, *dictionary_label_, *size_label_;
  bool filling_ = false;
};

}  // namespace capstan::widgets
