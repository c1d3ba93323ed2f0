#pragma once

#include <QTextBrowser>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Description of a hypothesis: definition, symptoms, the motion that shows it best, equation and source.
class HypothesisCard : public QTextBrowser {
  Q_OBJECT

 public:
  explicit HypothesisCard(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Shows an effect. `place`: where it was found or searched. `remark`: a line on top; empty: none.
  void showEffect(const std::string& effect, const QString& place, const QString& remark = {});
  /// For a report without a cause: shows the residual, and the variables that it depends on.
  void showRemains(const diagnosis::Report& report);
  QSize sizeHint() const override { return {300, 150}; }
  QSize minimumSizeHint() const override { return {160, 60}; }

 private:
  void show(const QString& html);

  Theme theme_ = Theme::dark();
  QString html_;
};

}  // namespace capstan::widgets
