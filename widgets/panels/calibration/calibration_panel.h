#pragma once

#include <QWidget>
#include <array>
#include <memory>
#include <optional>

#include "core/tracking/sample.h"
#include "core/vision/calibration_views.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"

class QLabel;
class QPushButton;

namespace capstan::widgets {

class BoardForm;
class CoveragePicture;
class ViewTable;

/// Calibration of the cameras: views of a board from the running session or from a folder, their coverage,
/// the errors of every view, and the files of the result (ROS camera_info). Boards are looked for, and
/// cameras fitted, in the background.
class CalibrationPanel : public QWidget {
  Q_OBJECT

 public:
  explicit CalibrationPanel(QWidget* parent = nullptr);
  ~CalibrationPanel() override;

  void setTheme(const Theme& theme);
  void showFrames(const tracking::StereoFrame& frame);
  /// Stops the collection of views, as when the panel is closed.
  void stop();

  /// Adds the pairs of images of a folder, left*.png and right*.png and other formats.
  void addFolder(const QString& folder);
  /// Writes left.yaml and right.yaml; false: refused, with a message.
  bool save(const QString& folder);
  bool saveImages(const QString& folder);

  bool collecting() const { return collecting_; }
  bool busy() const { return look_.busy() || fit_.busy(); }
  const vision::CalibrationViews& views() const { return *views_; }
  const std::optional<vision::CalibrationReport>& report() const { return report_; }
  BoardForm& form() { return *form_; }
  QString message() const;
  QSize sizeHint() const override { return {860, 760}; }

 private:
  QWidget* makeButtons();
  QWidget* makeResult();
  void clear();
  void setCollecting(bool on);
  void observeNewest();
  void take(std::shared_ptr<vision::CalibrationViews> views,
            const vision::CalibrationViews::Observation& seen);
  void exclude(int view, bool out);
  void calibrate();
  void useOtherBoard();
  void refresh();
  void say(const QString& text, bool warning = false);
  QString resultText() const;
  void askFolder(const QString& title, void (CalibrationPanel::*then)(const QString&));
  void saveAt(const QString& folder) { (void)save(folder); }
  void saveImagesAt(const QString& folder) { (void)saveImages(folder); }

  Theme theme_ = Theme::dark();
  std::shared_ptr<const vision::CalibrationViews> views_;
  std::optional<vision::CalibrationReport> report_;  ///< of exactly these views
  std::array<cv::Mat, 2> frame_;
  double frame_t_ = 0.0;
  bool fresh_ = false;  ///< the frame was not looked at
  bool collecting_ = false, warning_ = false;
  Job look_, fit_;
  BoardForm* form_;
  QPushButton *collect_, *folder_, *clear_, *calibrate_, *save_, *save_images_, *other_;
  QLabel *count_, *message_, *result_;
  std::array<CoveragePicture*, 2> pictures_{};
  ViewTable* table_;
};

}  // namespace capstan::widgets
