#pragma once

#include <QWidget>
#include <array>
#include <string_view>

#include "core/live/occlusion.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"
#include "widgets/panels/occlusion/hold_keys.h"

class QButtonGroup;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace capstan::widgets {

class OcclusionTimeline;

/// Block the cameras by hand or by schedule, and see what the filter observes meanwhile.
/// Left, right and both are toggles (keys L, K and B); held longer than a third of a second they block only
/// as long.
class OcclusionPanel : public QWidget {
  Q_OBJECT

 public:
  explicit OcclusionPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// The observation line and the timeline's now.
  void showSnapshot(const tracking::Snapshot& snapshot);
  /// What is blocked in fact, by hand or by schedule: marks the buttons.
  void showBlocked(const std::array<bool, 2>& blocked);
  /// Takes a schedule over without emitting it; for a restored session.
  void setSchedule(const live::OcclusionSchedule& schedule);
  /// Another session begins at `t` [s], free: occlusion belongs to a session. `again`: it is the same one
  /// from its beginning; block and schedule stay as they are set, the schedule restarts.
  void beginSession(double t, bool again);
  /// Nothing to block: a recording without cameras, or none at all.
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

  Theme theme_ = Theme::dark();
  std::array<QPushButton*, 3> buttons_{};
  std::array<HoldToggle, 3> holds_;
  std::array<bool, 2> before_{};                    // of the press that is being held
  std::array<bool, 2> hand_{};                      // set by hand
  std::array<bool, 2> blocked_{};                   // in fact
  std::array<bool, 3> marked_on_{}, marked_lit_{};  // as the buttons show it
  QButtonGroup* shares_ = nullptr;
  QDoubleSpinBox* interval_ = nullptr;
  OcclusionTimeline* timeline_ = nullptr;
  QLabel* now_ = nullptr;
  QLabel* reason_ = nullptr;
  QLabel* schedule_state_ = nullptr;
  HoldKeys* keys_ = nullptr;
  live::OcclusionSchedule schedule_;
  tracking::Gate gate_ = tracking::Gate::kNoCamera;
  std::string_view gate_words_ = base::nameOf(gate_);
  bool tip_alone_ = false;  // measured elsewhere, no pictures
  std::array<vision::MarkerFault, 2> faults_{};
  double t_ = 0.0;
};

}  // namespace capstan::widgets
