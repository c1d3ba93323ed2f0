#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Candidates of each expansion of the search (diagnosis::rankedCandidates()), those of the model marked. The
/// bar is the reduction of the residual's mean square by a trial fit, as a share. Candidates that were only
/// screened have an outline: the reduction predicted by the score test.
class RankingTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kName, kTaken, kScore, kProbability, kColumns };

  explicit RankingTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);
  /// The selected candidate; null: none.
  const diagnosis::Candidate* chosen() const;
  const robot::Description& robot() const { return robot_; }
  /// Rows as text, one per candidate: "● Backlash, joint 2 | 91 % | 412 | 97 %".
  QStringList lines() const;

 signals:
  void chosenChanged();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill();
  static QString takenText(double taken);
  void addNote(const QString& words);
  void addCandidate(QTreeWidgetItem* round, std::size_t index);

  Theme theme_ = Theme::dark();
  robot::Description robot_;
  std::vector<diagnosis::Candidate> candidates_;  ///< candidates in the order shown
  std::vector<bool> in_model_;                    ///< of each candidate
};

}  // namespace capstan::widgets
