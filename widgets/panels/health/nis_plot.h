#pragma once

#include <QWidget>
#include <array>

#include "core/tracking/health.h"
#include "core/tracking/innovation_record.h"
#include "widgets/figures/theme.h"

class QCPAxisRect;
class QCPGraph;
class QCPItemRect;
class QCPItemStraightLine;
class QCustomPlot;

namespace capstan::widgets {

/// NIS of every joint over time, one below the other, on a logarithmic scale: mean of each window of the
/// record, the band that passes, and a line at 1.
class NisPlot : public QWidget {
  Q_OBJECT

 public:
  explicit NisPlot(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showRecord(const tracking::InnovationRecord& record);
  void clear() { showRecord({}); }
  int points() const;
  QSize minimumSizeHint() const override { return {320, 240}; }
  QSize sizeHint() const override { return {520, 270}; }

 private:
  struct Joint {
    QCPAxisRect* axes;
    QCPGraph* nis;
    QCPItemRect* band;
    QCPItemStraightLine* one;
  };
  Joint addJoint(int joint);

  tracking::HealthLimits limits_;
  QCustomPlot* plot_;
  std::array<Joint, 3> joints_{};
};

}  // namespace capstan::widgets
