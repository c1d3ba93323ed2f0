#pragma once

#include <QWidget>

#include "core/live/occlusion.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Timeline of the occlusion schedule: some seconds of the past and the time ahead, with blocked time shaded
/// and the present as a line.
class OcclusionTimeline : public QWidget {
  Q_OBJECT

 public:
  explicit OcclusionTimeline(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void setSchedule(const live::OcclusionSchedule& schedule);
  void setNow(double t);
  /// Horizontal position of time t [px].
  double xOf(double t) const;
  QSize sizeHint() const override { return {200, 46}; }
  QSize minimumSizeHint() const override { return {120, 46}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Theme theme_ = Theme::dark();
  live::OcclusionSchedule schedule_;
  double now_ = 0.0;
};

}  // namespace capstan::widgets
