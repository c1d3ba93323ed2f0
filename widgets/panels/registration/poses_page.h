#pragma once

#include <Eigen/Geometry>
#include <QWidget>
#include <memory>
#include <optional>

#include "core/registration/pose_collector.h"
#include "core/registration/registration_history.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"

class QComboBox;
class QLabel;
class QPushButton;
class QScrollArea;
class QTableWidget;
class QTableWidgetItem;

namespace capstan::widgets {

/// Registration in several poses, by a registration::PoseCollector: poses with their residuals and the shift
/// by each, the result over the workspace, a check at three further poses, and the decision.
class PosesPage : public QWidget {
  Q_OBJECT

 public:
  explicit PosesPage(QWidget* parent = nullptr);
  ~PosesPage() override;

  void setTheme(const Theme& theme);
  /// Begins for a robot. `current`: the registration in use. Poses on the page stay. `taken`: where they were
  /// taken, as "in the session a.capstan", if new ones cannot join them: the page then only saves or clears
  /// them, and drops those that are not unsaved(). Empty: new poses join them.
  void begin(const robot::Description& robot, const std::optional<Eigen::Isometry3d>& current,
             const QString& taken = {});
  /// Sets the registration in use.
  void setCurrent(const Eigen::Isometry3d& base_from_camera);
  /// Fits the poses again for other constants of the robot.
  void setRobot(const robot::Description& robot);
  void showSnapshot(const tracking::Snapshot& snapshot);
  /// Sets whether the session has ended, so that no more frames arrive.
  void setEnded(bool ended);

  /// Ends the collection and a check; the poses stay.
  void stop();
  /// Whether the page has poses that are neither in an accepted registration nor saved.
  bool unsaved() const { return unsaved_; }
  /// Whether the poses were taken elsewhere, so that new ones cannot join them.
  bool elsewhere() const { return !taken_.isEmpty(); }
  /// Writes the poses to a file. False: it cannot be written, and the page gives the reason.
  bool saveTo(const QString& file);
  /// Asks for a file and writes the poses to it. False: they are not saved.
  bool save();
  /// True while poses are collected or checked.
  bool active() const;
  const registration::PoseCollector* collector() const { return collector_.get(); }
  QString summary() const;

 signals:
  void accepted(const Eigen::Isometry3d& base_from_camera, const QString& summary);
  void rejected(const QString& reason);
  /// The poses of elsewhere were cleared: the page waits for begin().
  void cleared();
  /// Follows accepted() and rejected(). Date, robot and session are empty.
  void decided(const capstan::registration::HistoryEntry& entry);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  enum Column { kPose, kX, kY, kZ, kResidual, kShift, kVerdict, kColumns };

  void makeTable();
  QWidget* makeTexts();
  QLayout* makeCollection();
  QWidget* makeDecision();
  void setCollecting(bool on);
  void accept();
  void reject();
  void clear();
  void refresh();
  void refreshButtons();
  void refreshTexts();
  void fillTable();
  void fillRow(int row);

  Theme theme_ = Theme::dark();
  std::unique_ptr<registration::PoseCollector> collector_;
  std::optional<Eigen::Isometry3d> current_;
  QLabel *count_, *origin_, *result_, *refusal_, *robot_warning_, *closures_;
  QScrollArea* texts_;
  QTableWidget* table_;
  QComboBox* reason_;
  QPushButton *collect_, *clear_, *save_, *check_, *accept_, *reject_;
  QString wrong_constants_;  ///< warning of the newest snapshot; empty: none
  QString taken_;            ///< where the poses were taken, if new ones cannot join them
  QString fault_;            ///< why the poses could not be saved; empty: they could
  bool filling_ = false, ended_ = false, unsaved_ = false;
};

}  // namespace capstan::widgets
