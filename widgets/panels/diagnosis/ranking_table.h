#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Candidates of each round of the selection, the best first. The bar is the share of the residual's mean
/// square that a candidate takes off data not fitted; of those that were only screened an outline, what the
/// score test score_tests.
class RankingTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kName, kTaken, kScore, kProbability, kColumns };

  explicit RankingTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);
  /// The candidate chosen; null: none.
  const diagnosis::Candidate* chosen() const;
  const robot::Description& robot() const { return robot_; }
  /// "Backlash of the cable drive, joint 2 (elbow) | 91 % | 412 | 97 %", line by line.
  QStringList lines() const;

 signals:
  void chosenChanged();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  static QString takenText(double taken);
  void addCandidate(QTreeWidgetItem* round, std::size_t index);

  Theme theme_ = Theme::dark();
  robot::Description robot_;
  std::vector<diagnosis::Candidate> candidates_;  ///< as shown
};

}  // namespace capstan::widgets
