#pragma once

#include <QTreeWidget>

#include "core/analysis/analysis.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Numbers of an analysis: one group per measure (RMS, median, IQR, mean), one line per joint and estimator.
/// A line has A, B, their difference with its 95 % interval, P beside the means, and the numbers of samples
/// (one column where they are equal). The first lines name the robots that the numbers belong to. A
/// difference whose interval excludes zero is bold.
class AnalysisTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kName, kA, kB, kDifference, kInterval, kP, kCountA, kCountB, kColumns };

  explicit AnalysisTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showAnalysis(const analysis::Analysis& analysis);
  /// The line of a measure, joint (0…2) and estimator; null: not shown.
  const QTreeWidgetItem* line(analysis::Measure measure, int joint, experiments::Estimator estimator) const;
  /// The lines before the groups: whose kinematics and filter the numbers belong to.
  QString noteWords() const;
  QSize sizeHint() const override { return {560, 230}; }
  QSize minimumSizeHint() const override { return {200, 90}; }

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void addNotes();
  void addNote(const QString& text);
  void addGroup(analysis::Measure measure);
  void fill(QTreeWidgetItem& item, const analysis::AnalysisRow& row, analysis::Measure measure) const;

  Theme theme_ = Theme::dark();
  QString numberText(double value, bool sign = false) const;

  analysis::Analysis analysis_;
  int notes_ = 0;  ///< number of lines before the groups
  int decimals_ = 3;
};

}  // namespace capstan::widgets
