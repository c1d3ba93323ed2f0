#include "widgets/panels/diagnosis/ranking_table.h"

#include <QHeaderView>
#include <QTreeWidgetItemIterator>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/report/report_tables.h"
#include "widgets/figures/number_text.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/table_font.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {

namespace {

using diagnosis::Candidate;

constexpr int kCandidateRole = Qt::UserRole + 1;

QString scoreText(double score) {
  return std::isfinite(score) ? withMinus(QString::number(score, 'f', std::abs(score) < 10.0 ? 1 : 0))
                              : QStringLiteral("—");
}

/// Tool tip in several lines.
QString wrappedTip(const std::string& words) {
  return QStringLiteral("<p>%1</p>").arg(QString::fromStdString(words).toHtmlEscaped());
}

}  // namespace

RankingTable::RankingTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("ranking");
  setColumnCount(kColumns);
  setHeaderLabels({tr("candidate"), tr("trial fit\nremoves"), tr("trial\nscore"), tr("final\nprobability")});
  headerItem()->setToolTip(
      kTaken,
      tr("Share of the mean square of the round's residual that a short trial fit with the effect removes; "
         "outlined: prediction of the score test for candidates without a trial fit"));
  headerItem()->setToolTip(
      kScore, tr("Log-likelihood of a short trial fit with the effect minus that without it [nats]"));
  headerItem()->setToolTip(kProbability, wrappedTip(diagnosis::rankingNote()));
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
  candidates_ = diagnosis::rankedCandidates(report);
  in_model_.clear();
  for (const Candidate& candidate : candidates_) in_model_.push_back(diagnosis::isInModel(report, candidate));
  fill();
}

void RankingTable::fill() {
  const QSignalBlocker quiet(this);
  clear();
  if (!candidates_.empty()) addNote(QString::fromStdString(diagnosis::rankingNote()));
  QTreeWidgetItem* round = nullptr;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!round || candidates_[i].round != candidates_[i - 1].round) {
      round = new QTreeWidgetItem({tr("expansion %1 of the search").arg(candidates_[i].round)});
      round->setFlags(Qt::ItemIsEnabled);
      round->setForeground(kName, theme_.muted);
      round->setFont(kName, textFont(kTableFont - 0.5));
      addTopLevelItem(round);
      round->setFirstColumnSpanned(true);
    }
    addCandidate(round, i);
  }
  expandAll();
  wrapWords(*this, kName);
}

void RankingTable::addNote(const QString& words) {
  auto* note = new QTreeWidgetItem;
  setWords(*note, kName, words);
  note->setFlags(Qt::ItemIsEnabled);
  note->setForeground(kName, theme_.muted);
  note->setFont(kName, textFont(kTableFont - 0.5));
  addTopLevelItem(note);
  note->setFirstColumnSpanned(true);
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
  const bool in_model = in_model_[index];
  setWords(*item, kName,
           (in_model ? QStringLiteral("● ") : QString()) + titleOf(candidate.effect) + QStringLiteral(", ") +
               placeOf(candidate.effect, candidate.joint, {}));
  item->setToolTip(kName, titleOf(candidate.effect) + QStringLiteral(", ") +
                              placeOf(candidate.effect, candidate.joint, robot_) +
                              (in_model ? tr(": in the model of the verdict") : QString()));
  item->setText(kTaken, takenText(taken));
  item->setText(kScore, scoreText(candidate.score));
  const std::string percent = diagnosis::candidatePercent(candidate);
  item->setText(kProbability, QString::fromStdString(percent) +
                                  (candidate.probability > 0.0 ? QStringLiteral(" %") : QString()));
  item->setFont(kName, textFont(kTableFont, in_model));
  for (const int column : {kTaken, kScore, kProbability}) item->setFont(column, numberFont(kTableFont));
  for (const int column : {kTaken, kScore, kProbability})
    item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  if (!candidate.refitted && !in_model)
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
