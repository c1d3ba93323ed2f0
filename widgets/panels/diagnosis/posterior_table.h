#pragma once

#include <QTreeWidget>

#include "core/base/table.h"
#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Posterior over sets of effects: the most probable sets, each with its probability as a bar. Below them the
/// probability of all others.
class PosteriorTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kEffects, kProbability, kColumns };

  explicit PosteriorTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);
  /// Rows as text, one per set: "Backlash (joint 2) | 87.0 %".
  QStringList lines() const;

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  void addNote(const QString& words);

  Theme theme_ = Theme::dark();
  base::Table table_;
};

}  // namespace capstan::widgets
