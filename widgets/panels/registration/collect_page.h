#pragma once

#include <QWidget>

#include "core/registration/registration_guide.h"
#include "widgets/figures/theme.h"
#include "widgets/panels/registration/scatter_plot.h"

class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;

namespace capstan::widgets {

/// Step 2: collects frames and shows their scatter, σ per axis, and each rejected point with its reason. It
/// also shows why a collection was refused.
class CollectPage : public QWidget {
  Q_OBJECT

 public:
  explicit CollectPage(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showGuide(const registration::RegistrationGuide& guide);
  /// Sets whether the session has ended, so that no more frames arrive.
  void setEnded(bool ended);
  ScatterPlot& plot() { return *plot_; }
  QString refusal() const;

 signals:
  void againRequested();
  void backRequested();
  /// The cameras are exchanged, as the refusal says.
  void exchangeRequested();

 private:
  void listOutliers(const registration::RegistrationGuide& guide);

  Theme theme_ = Theme::dark();
  ScatterPlot* plot_;
  QProgressBar* progress_;
  QLabel* count_;
  QLabel* sigma_;
  QListWidget* outliers_;
  QLabel* refusal_;
  QPushButton *back_, *exchange_, *again_;
  bool ended_ = false;
};

}  // namespace capstan::widgets
