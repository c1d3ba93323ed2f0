#pragma once

#include <QTableWidget>
#include <vector>

#include "core/vision/calibration.h"

namespace capstan::widgets {

/// The views of a calibration: one row each, with its errors in pixels and a box that excludes it.
class ViewTable : public QTableWidget {
  Q_OBJECT

 public:
  explicit ViewTable(QWidget* parent = nullptr);
  /// Fills the table; `fitted`: the errors are those of a calibration with exactly these views.
  void showViews(const std::vector<vision::CalibrationView>& views, bool fitted);

 signals:
  void excluded(int view, bool out);

 private:
  bool filling_ = false;
};

}  // namespace capstan::widgets
