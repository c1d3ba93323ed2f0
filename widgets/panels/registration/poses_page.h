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
  /// Starts again for a robot. `current`: the registration in use.
  void begin(const robot::Description& robot, const std::optional<Eigen::Isometry3d>& current);
  /// Fits the poses again for other constants of the robot.
  void setRobot(const robot::Description& robot);
  void showSnapshot(const tracking::Snapshot& snapshot);
  /// Sets whether the session has ended, so that no more frames arrive.
  void setEnded(bool ended);

  /// Ends the collection; the poses stay.
  void stop();
  /// True while poses are collected or checked.
  bool active() const;
  const registration::PoseCollector* collector() const { return collector_.get(); }
  QString summary() const;

 signals:
  void accepted(const Eigen::Isometry3d& base_from_camera, const QString& summary);
  void rejected(const QString& reason);
  /// Follows accepted() and rejected(). Date, robot and session are empty.
  void decided(const capstan::registration::HistoryEntry& entry);

 private:
  enum Column { kPose, kX, kY, kZ, kResidual, kShift, kVerdict, kColumns };

  void makeTable();
  QWidget* makeDecision();
  void setCollecting(bool on);
  void accept();
  void reject();
  void refresh();
  void fillTable();
  void fillRow(int row);
  QString resultText() const;
  QString closureText() const;
  void savePoses();

  Theme theme_ = Theme::dark();
  std::unique_ptr<registration::PoseCollector> collector_;
  std::optional<Eigen::Isometry3d> current_;
  QLabel *count_, *result_, *refusal_, *closures_;
  QTableWidget* table_;
  QComboBox* reason_;
  QPushButton *collect_, *clear_, *save_, *check_, *accept_, *reject_;
  QString wrong_constants_;  ///< warning of the newest snapshot; empty: none
  bool filling_ = false, ended_ = false;
};

}  // namespace capstan::widgets
