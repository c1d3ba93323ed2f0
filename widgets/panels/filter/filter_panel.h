#pragma once

#include <QWidget>

#include "core/tracking/options.h"
#include "widgets/figures/theme.h"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace capstan::widgets {

/// Filter options of the running session: filter, one blocked camera, gate, epipolar limit, camera delay; the
/// others from a file. A change is reported at once.
class FilterPanel : public QWidget {
  Q_OBJECT

 public:
  explicit FilterPanel(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Another session begins with `options`, which those of the panel are compared with.
  void begin(const tracking::TrackingOptions& options);
  /// Shows other options without a signal.
  void setOptions(const tracking::TrackingOptions& options);
  const tracking::TrackingOptions& options() const { return options_; }
  /// Options that differ from those of the session's source; or why a file was refused.
  QString words() const;
  /// Reads a file of filter options. The panel shows errors.
  void load(const QString& file);
  QSize sizeHint() const override { return {420, 330}; }
  QSize minimumSizeHint() const override { return {360, 260}; }

 signals:
  /// The user changed the setting `name`.
  void changed(const capstan::tracking::TrackingOptions& options, const QString& name);

 private:
  QComboBox* addChoice(QFormLayout& form, const QString& label, const QString& key, const QString& tip);
  QDoubleSpinBox* addNumber(QFormLayout& form, const QString& label, const QString& key, const QString& tip);
  template <class Enum>
  void fill(QComboBox& box, Enum tracking::TrackingOptions::*field, const QString& name);
  void follow(QDoubleSpinBox& box, double tracking::TrackingOptions::*field, double unit,
              const QString& name);
  void take(const tracking::TrackingOptions& options, const QString& name);
  void refresh();

  Theme theme_ = Theme::dark();
  tracking::TrackingOptions options_, source_;
  bool open_ = false;
  QString refusal_;
  QComboBox *filter_, *one_camera_;
  QDoubleSpinBox *gate_, *epipolar_, *delay_;
  QPushButton *load_, *reset_;
  QLabel* words_;
};

}  // namespace capstan::widgets
