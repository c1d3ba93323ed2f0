#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "core/registration/camera_checks.h"
#include "core/registration/registration_guide.h"
#include "core/registration/registration_history.h"
#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"
#include "core/vision/registration.h"
#include "widgets/figures/theme.h"

class QLabel;
class QPushButton;
class QStackedWidget;
class QTabWidget;

namespace capstan::widgets {

class CameraStrip;
class CollectPage;
class HistoryPage;
class PosesPage;
class ResultPage;
class StepBar;
class StopPage;

/// Registration during the running session: at the hard stop in three steps, by a
/// registration::RegistrationGuide, or in several poses, which also gives the rotation (PosesPage); and the
/// history of both (HistoryPage). The owner passes it every snapshot with camera_updated and, for the
/// overlay, frames.
class RegistrationPanel : public QWidget {
  Q_OBJECT

 public:
  explicit RegistrationPanel(QWidget* parent = nullptr);
  ~RegistrationPanel() override;

  void setTheme(const Theme& theme);
  /// Starts again for a source. `in_use`: the registration in use; without one, the guide assumes that the
  /// rotation of `nominal`, the nominal mounting of the cameras, is known. `poses_taken`: as
  /// PosesPage::begin().
  void begin(const tracking::SourceInfo& source, const std::optional<Eigen::Isometry3d>& in_use,
             const std::optional<Eigen::Isometry3d>& nominal = {}, const vision::MarkerOptions& marker = {},
             const QString& poses_taken = {});
  /// Says which registration is in use now.
  void setInUse(const Eigen::Isometry3d& base_from_camera);
  /// Ends the guide and the collection of poses; collected poses stay.
  void leave();
  void showSnapshot(const tracking::Snapshot& snapshot);
  void showFrames(const cv::Mat& left, const cv::Mat& right, const tracking::Snapshot& snapshot);

  /// Sets whether the session has ended, so that no more frames arrive and the arm cannot be moved.
  void setEnded(bool ended);

  /// True while the guide or the collection of poses takes snapshots.
  bool active() const;
  const registration::RegistrationGuide* guide() const { return guide_.get(); }
  CameraStrip& cameras() { return *cameras_; }
  StopPage& stopPage() { return *stop_; }
  CollectPage& collectPage() { return *collect_; }
  ResultPage& resultPage() { return *result_; }
  PosesPage& posesPage() { return *poses_; }
  HistoryPage& historyPage() { return *history_; }
  QSize sizeHint() const override { return {680, 620}; }

 signals:
  void driveToHardStopRequested();
  /// The user accepted the registration; the owner passes it to the pipeline and stores it with the session.
  void accepted(const Eigen::Isometry3d& base_from_camera, const QString& summary);
  void rejected(const QString& reason);
  /// The user pressed the button that corrects the images or the cameras.
  void remedyRequested(const capstan::registration::CameraRemedy& remedy);
  /// The user accepted or rejected; follows accepted() and rejected(). Date, robot and session are empty.
  void decided(const capstan::registration::HistoryEntry& entry);
  /// The user cancelled, or closed the panel after the decision: the panel may be hidden.
  void finished();

 private:
  QWidget* makeHardStop();
  bool guiding() const;
  void refresh();
  void finish(const QString& message);

  Theme theme_ = Theme::dark();
  std::unique_ptr<registration::RegistrationGuide> guide_;
  bool registered_ = false;  ///< a registration is in use
  registration::RegistrationStep shown_ = registration::RegistrationStep::kIdle;
  int points_shown_ = -1;
  CameraStrip* cameras_;
  QTabWidget* tabs_;
  PosesPage* poses_;
  HistoryPage* history_;
  StepBar* steps_;
  QStackedWidget* pages_;
  StopPage* stop_;
  CollectPage* collect_;
  ResultPage* result_;
  QLabel* end_;
  QLabel* ended_;
  QPushButton* close_;
};

}  // namespace capstan::widgets
