#pragma once

#include <QWidget>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/tracking/sample.h"
#include "core/vision/marker.h"
#include "widgets/figures/theme.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace capstan::widgets {

class MarkerPicture;

/// Colour and shape limits of the marker: by a click on it in either picture, by hand, or from a marker file.
/// The pictures show the pixels inside the limits while the limits are changed.
class MarkerPanel : public QWidget {
  Q_OBJECT

 public:
  explicit MarkerPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Starts again with the options in use.
  void begin(const vision::MarkerOptions& options);
  void showFrames(const tracking::StereoFrame& frame);
  void clear();

  const vision::MarkerOptions& options() const { return options_; }
  MarkerPicture& picture(int side) { return *pictures_[static_cast<std::size_t>(side)]; }
  QString message() const;
  bool openFile(const QString& file);
  bool saveFile(const QString& file);

 signals:
  /// The user chose other options, which are to be used at once.
  void optionsChanged(const capstan::vision::MarkerOptions& options);

 private:
  QWidget* makeLimits();
  QWidget* makeButtons();
  void pick(int side, const QPoint& pixel);
  void use(const vision::MarkerOptions& options);
  void fill();
  void takeFields();
  void redraw();
  void say(const QString& text, bool warning);
  void askOpen();
  void askSave();

  vision::MarkerOptions options_;
  std::optional<vision::MarkerOptions> before_;  ///< those before the last change
  std::array<cv::Mat, 2> frames_;
  std::array<MarkerPicture*, 2> pictures_{};
  QSpinBox *hue_low_, *hue_high_, *saturation_, *value_;
  QDoubleSpinBox *radius_, *circularity_;
  QLabel* message_;
  QPushButton *undo_, *default_;
  Theme theme_ = Theme::dark();
  bool filling_ = false, warning_ = false;
};

}  // namespace capstan::widgets
