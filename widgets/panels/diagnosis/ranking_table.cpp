#include "widgets/panels/diagnosis/ranking_table.h"

#include <QHeaderView>
#include <QTreeWidgetItemIterator>
#include <algorithm>
#include <cmath>

#include "widgets/figures/number_text.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {

namespace {

using diagnosis::Candidate;

constexpr int kCandidateRole = Qt::UserRole + 1;
constexpr double kPoints = 10.0;

/// Order of candidates: refitted ones by their score, then screened ones by the reduction that the score test
/// predicts.
bool better(const Candidate& a, const Candidate& b) {
  if (a.round != b.round) return a.round < b.round;
  if (a.refitted != b.refitted) return a.refitted;
  return a.refitted ? a.score > b.score : a.screened > b.screened;
}

QString scoreText(double score) {
  return std::isfinite(score) ? withMinus(QString::number(score, 'f', std::abs(score) < 10.0 ? 1 : 0))
                              : QStringLiteral("—");
}

}  // namespace

RankingTable::RankingTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("ranking");
  setColumnCount(kColumns);
  setHeaderLabels({tr("candidate"), tr("takes off"), tr("score"), tr("probability")});
  headerItem()->setToolTip(kTaken, tr("Reduction of the residual's mean square by a short refit; outlined: "
                                      "prediction of the score test for candidates that were not refitted"));
  headerItem()->setToolTip(
      kScore, tr("Log-likelihood of a short refit with the effect minus that without it [nats]"));
  setItemDelegateForColumn(kTaken, new ShareBar(this));
  setRootIsDecorated(false);
  setItemsExpandable(false);
  setIndentation(10);
  setFrameShape(QFrame::NoFrame);
  setAllColumnsShowFocus(true);
  setAccessibleName(tr("ranking of the candidates"));
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(10);
  header()->setFont(textFont(9.0));
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  header()->setSectionResizeMode(kTaken, QHeaderView::Fixed);
  for (const int column : {kTaken, kScore, kProbability})
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  connect(header(), &QHeaderView::sectionResized, this, [this] { wrapWords(*this, kName); });
  connect(this, &QTreeWidget::currentItemChanged, this, [this] { Q_EMIT chosenChanged(); });
}

void RankingTable::resizeEvent(QResizeEvent* event) {
  constexpr int kBarShare = 26;  // of the width [%]
  QTreeWidget::resizeEvent(event);
  header()->resizeSection(kTaken, kBarShare * viewport()->width() / 100);
}

void RankingTable::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 2px 4px; } "
                               "QTreeWidget::item:selected { background: %1; color: %2; }")
                    .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void RankingTable::showReport(const diagnosis::Report& report) {
  robot_ = report.extended;
  candidates_ = report.candidates;
  std::stable_sort(candidates_.begin(), candidates_.end(), better);
  fill();
}

void RankingTable::fill() {
  const QSignalBlocker quiet(this);
  clear();
  QTreeWidgetItem* round = nullptr;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!round || candidates_[i].round != candidates_[i - 1].round) {
      round = new QTreeWidgetItem({tr("expansion %1 of the search").arg(candidates_[i].round)});
      round->setFlags(Qt::ItemIsEnabled);
      round->setForeground(kName, theme_.muted);
      round->setFont(kName, textFont(kPoints - 0.5));
      addTopLevelItem(round);
      round->setFirstColumnSpanned(true);
    }
    addCandidate(round, i);
  }
  expandAll();
  wrapWords(*this, kName);
}

/// Text of the reduction. A candidate that more than doubles the mean square is only called "worse".
QString RankingTable::takenText(double taken) {
  if (taken < -1.0) return tr("worse");
  const double shown = std::abs(taken) < 5e-4 ? 0.0 : taken;
  return percentText(shown, std::abs(shown) < 0.1 ? 1 : 0);
}

void RankingTable::addCandidate(QTreeWidgetItem* round, std::size_t index) {
  const Candidate& candidate = candidates_[index];
  const double taken = candidate.refitted ? candidate.reduction : candidate.screened;
  auto* item = new QTreeWidgetItem;
  setWords(*item, kName,
           titleOf(candidate.effect) + QStringLiteral(", ") + placeOf(candidate.effect, candidate.joint, {}));
  item->setToolTip(kName, titleOf(candidate.effect) + QStringLiteral(", ") +
                              placeOf(candidate.effect, candidate.joint, robot_));
  item->setText(kTaken, takenText(taken));
  item->setText(kScore, scoreText(candidate.score));
  item->setText(kProbability, candidate.refitted ? percentText(candidate.probability) : QStringLiteral("—"));
  item->setFont(kName, textFont(kPoints));
  for (const int column : {kTaken, kScore, kProbability}) item->setFont(column, numberFont(kPoints));
  for (const int column : {kTaken, kScore, kProbability})
    item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  if (!candidate.refitted)
    for (int column = 0; column < kColumns; ++column) item->setForeground(column, theme_.muted);
  item->setData(0, kCandidateRole, static_cast<int>(index));
  ShareBar::set(*item, kTaken, taken, candidate.refitted ? theme_.accent : theme_.muted, candidate.refitted);
  round->addChild(item);
}

const Candidate* RankingTable::chosen() const {
  const QVariant index = currentItem() ? currentItem()->data(0, kCandidateRole) : QVariant();
  return index.isValid() ? &candidates_[static_cast<std::size_t>(index.toInt())] : nullptr;
}

QStringList RankingTable::lines() const {
  QStringList lines;
  for (QTreeWidgetItemIterator it(const_cast<RankingTable*>(this)); *it; ++it) {
    if (!(*it)->data(0, kCandidateRole).isValid()) continue;
    QStringList cells;
    for (int column = 0; column < kColumns; ++column) cells << wordsOf(**it, column);
    lines << cells.join(QStringLiteral(" | "));
  }
  return lines;
}

}  // namespace capstan::widgets
