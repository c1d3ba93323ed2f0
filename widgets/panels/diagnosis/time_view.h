#pragma once

#include <QWidget>
#include <memory>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/residual_figure.h"

class QComboBox;
class QLabel;
class QVBoxLayout;

namespace capstan::widgets {

/// One channel over time: measured, simulated by the three models, and its residual before and after.
/// Drag and wheel move and stretch the time; a double click shows all of it.
class TimeView : public QWidget {
  Q_OBJECT

 public:
  explicit TimeView(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showReport(std::shared_ptr<const diagnosis::Report> report);
  /// The first recording's channel of this name; nothing where there is none.
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
  bool stale_ = false;  ///< what is drawn is not what is chosen: drawn when it is looked at
  QComboBox* channels_;
  QLabel* words_;
  QVBoxLayout* sheet_;
  ResidualFigure* figure_ = nullptr;
};

}  // namespace capstan::widgets
