#pragma once

#include <QTextBrowser>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// The words of a hypothesis: what it is, how it shows, which motion would show it best, equation and source.
class HypothesisCard : public QTextBrowser {
  Q_OBJECT

 public:
  explicit HypothesisCard(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// `place`: where it was found or looked for. `remark`: a line on top, or nothing.
  void showEffect(const std::string& effect, const QString& place, const QString& remark = {});
  /// Of a report without a cause: what remains, and on what it depends.
  void showRemains(const diagnosis::Report& report);
  QSize sizeHint() const override { return {300, 150}; }
  QSize minimumSizeHint() const override { return {160, 60}; }

 private:
  void show(const QString& html);

  Theme theme_ = Theme::dark();
  QString html_;
};

}  // namespace capstan::widgets
