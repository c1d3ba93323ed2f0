#pragma once

#include <QWidget>
#include <array>
#include <string_view>

#include "core/live/occlusion.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"
#include "widgets/panels/occlusion/hold_keys.h"

class QButtonGroup;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace capstan::widgets {

class OcclusionTimeline;

/// Blocks the cameras by hand or by schedule, and shows which measurements the filter uses meanwhile. The
/// buttons left, right and both are toggles (keys L, K and B); a press longer than a third of a second blocks
/// only until its release. The schedule blocks both cameras or one of them: then the filter may go on with
/// the ray of the other one (tracking::OneCamera).
class OcclusionPanel : public QWidget {
  Q_OBJECT

 public:
  explicit OcclusionPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Updates the observation line and the present time of the timeline.
  void showSnapshot(const tracking::Snapshot& snapshot);
  /// Marks the buttons of cameras that are actually blocked, by hand or by schedule.
  void showBlocked(const std::array<bool, 2>& blocked);
  /// Sets the schedule without emitting a signal; for a restored session.
  void setSchedule(const live::OcclusionSchedule& schedule);
  /// Another session begins at `t` [s], without occlusion. `again`: it is the same session from its
  /// beginning; blocks by hand and schedule are kept, and the schedule restarts.
  void beginSession(double t, bool again);
  /// Sets whether there are cameras to block: false for a recording without cameras, or without a session.
  void setBlockable(bool blockable);

  const live::OcclusionSchedule& schedule() const { return schedule_; }
  std::array<bool, 2> blocked() const { return hand_; }
  QString observation() const;
  QString reason() const;

 signals:
  void blockChanged(bool left, bool right);
  void scheduleChanged(const capstan::live::OcclusionSchedule& schedule);

 private:
  enum Which { kLeft, kRight, kBoth };
  void addBlockButtons(QVBoxLayout* column);
  void addSchedule(QVBoxLayout* column);
  void press(Which which);
  void release(Which which);
  void set(std::array<bool, 2> blocked);
  void changeSchedule();
  void markButtons();
  bool scheduledNow() const;

  Theme theme_ = Theme::dark();
  std::array<QPushButton*, 3> buttons_{};
  std::array<HoldToggle, 3> holds_;
  std::array<bool, 2> before_{};                    // state before the present press
  std::array<bool, 2> hand_{};                      // blocked by hand
  std::array<bool, 2> blocked_{};                   // actually blocked
  std::array<bool, 3> marked_on_{}, marked_lit_{};  // as shown by the buttons
  QButtonGroup* shares_ = nullptr;
  QComboBox* cameras_ = nullptr;
  QDoubleSpinBox* interval_ = nullptr;
  OcclusionTimeline* timeline_ = nullptr;
  QLabel* now_ = nullptr;
  QLabel* reason_ = nullptr;
  QLabel* schedule_state_ = nullptr;
  HoldKeys* keys_ = nullptr;
  live::OcclusionSchedule schedule_;
  tracking::Gate gate_ = tracking::Gate::kNoCamera;
  std::string_view gate_words_ = base::nameOf(gate_);
  bool ray_ = false;        // one camera alone is observed
  bool tip_alone_ = false;  // the tip is measured externally, without images
  std::array<vision::MarkerFault, 2> faults_{};
  double t_ = 0.0;
};

}  // namespace capstan::widgets
