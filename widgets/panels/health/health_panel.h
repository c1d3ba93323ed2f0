#pragma once

#include <QWidget>
#include <vector>

#include "core/tracking/health.h"
#include "widgets/figures/theme.h"

class QGridLayout;
class QLabel;

namespace capstan::widgets {

class NisPlot;

/// Health of the estimator: the verdict, NIS of every joint over time, and one row per check with verdict,
/// value and expectation; below a check that does not pass, its advice.
class HealthPanel : public QWidget {
  Q_OBJECT

 public:
  explicit HealthPanel(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Shows the checks and NIS over time; without checks, that nothing has been tracked yet.
  void showHealth(const std::vector<tracking::HealthCheck>& checks, const tracking::InnovationRecord& nis);
  const NisPlot& plot() const { return *plot_; }
  QString headline() const;
  QSize sizeHint() const override { return {560, 760}; }

 private:
  struct Row {
    QLabel *name, *verdict, *value, *advice;
  };
  void paintHeadline();
  void setRows(std::size_t count);
  void showRow(const Row& row, const tracking::HealthCheck& check);

  Theme theme_ = Theme::dark();
  std::vector<tracking::HealthCheck> checks_;
  QLabel* headline_;
  NisPlot* plot_;
  QGridLayout* grid_;
  std::vector<Row> rows_;
};

}  // namespace capstan::widgets
