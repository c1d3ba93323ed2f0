#pragma once

#include <QWidget>
#include <memory>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/residual_figure.h"

class QComboBox;
class QLabel;
class QVBoxLayout;

namespace capstan::widgets {

/// One channel over time: measured, simulated by the three models, and its residual before and after. Drag
/// and wheel move and zoom the time axis; a double click shows all of it.
class TimeView : public QWidget {
  Q_OBJECT

 public:
  explicit TimeView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showReport(std::shared_ptr<const diagnosis::Report> report);
  /// Shows the channel of this name in the first recording; does nothing without one.
  void showChannel(const std::string& name);
  QComboBox& channels() { return *channels_; }
  const ResidualFigure* figure() const { return figure_; }
  QString words() const;
  QSize minimumSizeHint() const override { return {300, 160}; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void draw();
  void showAll();

  const Theme* theme_ = &Theme::dark();
  std::shared_ptr<const diagnosis::Report> report_;
  bool stale_ = false;  ///< the drawing is out of date; it is redrawn when the view is shown
  QComboBox* channels_;
  QLabel* words_;
  QVBoxLayout* sheet_;
  ResidualFigure* figure_ = nullptr;
};

}  // namespace capstan::widgets
