#include "widgets/panels/analysis/analysis_table.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <algorithm>
#include <cmath>

#include "core/tracking/snapshot.h"
#include "widgets/figures/number_text.h"
#include "widgets/panels/analysis/analysis_figures.h"

namespace capstan::widgets {

using namespace analysis;
using namespace experiments;

namespace {

constexpr double kPoints = 9.5;
constexpr int kRowHeight = 20;  // [px]

QString countText(std::size_t n) { return n > 0 ? QString::number(n) : QStringLiteral("–"); }

}  // namespace

AnalysisTable::AnalysisTable(QWidget* parent) : QTreeWidget(parent) {
  setColumnCount(kColumns);
  setRootIsDecorated(false);
  setIndentation(10);
  setItemsExpandable(false);
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setAllColumnsShowFocus(true);
  setAccessibleName(tr("numbers of the analysis"));
  header()->setMinimumSectionSize(10);
  header()->setStretchLastSection(false);
  header()->setSectionsMovable(false);
  header()->setFont(textFont(kPoints));
  header()->setDefaultAlignment(Qt::AlignRight | Qt::AlignVCenter);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
}

void AnalysisTable::setTheme(const Theme& theme) {
  theme_ = theme;
  showAnalysis(analysis_);
}

void AnalysisTable::showAnalysis(const Analysis& analysis) {
  analysis_ = analysis;
  decimals_ = decimalsOf(analysis);
  const bool two = !analysis.title_b.empty();
  const bool differences = analysis.against != Against::kNothing;
  const bool same_counts = std::all_of(analysis.rows.begin(), analysis.rows.end(),
                                       [](const AnalysisRow& row) { return row.a.counts == row.b.counts; });
  setHeaderLabels({tr("deg and mm"), two ? QStringLiteral("A") : tr("value"), QStringLiteral("B"),
                   two ? QStringLiteral("B − A") : tr("UKF − kin."), tr("95 % interval"), QStringLiteral("P"),
                   two && !same_counts ? tr("n of A") : QStringLiteral("n"), tr("n of B")});
  headerItem()->setTextAlignment(kName, Qt::AlignLeft | Qt::AlignVCenter);
  headerItem()->setToolTip(kInterval, tr("95 % interval of the difference: circular block bootstrap, block "
                                         "length from the errors' autocorrelation"));
  headerItem()->setToolTip(kP, tr("P value of equal means, two-sided: t-test of block means; paired if both "
                                  "runs have the same instants, else Welch's"));
  setColumnHidden(kB, !two);
  setColumnHidden(kCountB, !two || same_counts);
  for (const int column : {kDifference, kInterval, kP}) setColumnHidden(column, !differences);
  clear();
  notes_ = 0;
  if (analysis.rows.empty()) return;
  addNotes();
  for (const Measure measure : kMeasures) addGroup(measure);
  expandAll();
}

/// Number as "−0.123"; zero has no sign.
QString AnalysisTable::numberText(double value, bool sign) const {
  if (!std::isfinite(value)) return QStringLiteral("–");
  const double shown = std::abs(value) < 0.5 * std::pow(10.0, -decimals_) ? 0.0 : value;
  QString text = QString::number(shown, 'f', decimals_);
  if (sign && shown > 0.0) text.prepend('+');
  return withMinus(text);
}

/// Lines over all columns: whose kinematics and filter the numbers belong to, and which samples were not
/// stored.
void AnalysisTable::addNotes() {
  const bool two = !analysis_.title_b.empty();
  const auto named = [&](const char* letter, const std::string& robots) {
    return two && !robots.empty() ? std::string(letter) + ": " + robots : robots;
  };
  for (const std::string& note : {named("A", analysis_.robots_a), named("B", analysis_.robots_b),
                                  thinningWords(analysis_), pairingWords(analysis_)})
    if (!note.empty()) addNote(QString::fromStdString(note));
}

void AnalysisTable::addNote(const QString& text) {
  auto* note = new QTreeWidgetItem(this);
  note->setText(kName, text);
  note->setToolTip(kName, text);
  note->setFont(kName, textFont(kPoints));
  note->setForeground(kName, theme_.text);
  note->setFlags(Qt::ItemIsEnabled);
  note->setFirstColumnSpanned(true);
  note->setSizeHint(kName, QSize(0, kRowHeight));
  ++notes_;
}

QString AnalysisTable::noteWords() const {
  QStringList notes;
  for (int i = 0; i < notes_; ++i) notes << topLevelItem(i)->text(kName);
  return notes.join('\n');
}

void AnalysisTable::addGroup(Measure measure) {
  auto* group = new QTreeWidgetItem(this);
  const bool absolute = analysis_.options.absolute && measure != Measure::kRms;
  const QString name = QString::fromStdString(std::string(base::nameOf(measure)));
  group->setText(kName, absolute ? tr("%1 of |error|").arg(name) : name);
  group->setFont(kName, textFont(kPoints, true));
  group->setForeground(kName, theme_.text);
  group->setFlags(Qt::ItemIsEnabled);
  group->setFirstColumnSpanned(true);
  group->setSizeHint(kName, QSize(0, kRowHeight));
  for (const AnalysisRow& row : analysis_.rows) fill(*new QTreeWidgetItem(group), row, measure);
}

void AnalysisTable::fill(QTreeWidgetItem& item, const AnalysisRow& row, Measure measure) const {
  const Difference& d = row.of(measure);
  const bool known = std::isfinite(d.value), pending = known && !analysis_.intervals;
  const QString interval = pending                ? tr("…")
                           : std::isfinite(d.low) ? QStringLiteral("%1 … %2").arg(numberText(d.low, true),
                                                                                  numberText(d.high, true))
                                                  : QString();
  const QString p = measure != Measure::kMean || !known ? QString()
                    : pending                           ? tr("…")
                              : withMinus(QString::fromStdString(probabilityText(row.p, row.log10_p)));
  item.setText(kName, QStringLiteral("q%1 %2, %3")
                          .arg(row.joint + 1)
                          .arg(nameOf(quantityOf(row.estimator)))
                          .arg(tracking::kJointUnits[static_cast<std::size_t>(row.joint)]));
  item.setText(kA, numberText(row.a.of(measure)));
  item.setText(kB, numberText(row.b.of(measure)));
  item.setText(kDifference, known ? numberText(d.value, true) : QString());
  item.setText(kInterval, interval);
  item.setText(kP, p);
  item.setText(kCountA, countText(row.a.count(measure)));
  item.setText(kCountB, countText(row.b.count(measure)));
  for (int column = 0; column < kColumns; ++column) {
    const bool strong = column == kDifference && d.clear();
    item.setFont(column, column == kName ? textFont(kPoints) : numberFont(kPoints, strong));
    item.setForeground(column, column == kCountA || column == kCountB ? theme_.muted : theme_.text);
    if (column > kName) item.setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  if (analysis_.intervals && known)
    item.setToolTip(kInterval, tr("%1 blocks of %2 samples, %3")
                                   .arg(row.blocks)
                                   .arg(row.block_length)
                                   .arg(row.paired ? tr("both runs at the same instants")
                                                   : tr("runs independent of each other")));
}

const QTreeWidgetItem* AnalysisTable::line(Measure measure, int joint, Estimator estimator) const {
  const auto* group = topLevelItem(static_cast<int>(measure) + notes_);
  if (!group) return nullptr;
  for (std::size_t i = 0; i < analysis_.rows.size(); ++i)
    if (analysis_.rows[i].joint == joint && analysis_.rows[i].estimator == estimator)
      return group->child(static_cast<int>(i));
  return nullptr;
}

/// Copies the selected lines, with cells separated by tabs.
void AnalysisTable::keyPressEvent(QKeyEvent* event) {
  if (!event->matches(QKeySequence::Copy)) return QTreeWidget::keyPressEvent(event);
  QStringList lines;
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    if (!(*it)->isSelected()) continue;
    QStringList cells;
    if ((*it)->parent()) cells << (*it)->parent()->text(kName);
    for (int column = 0; column < kColumns; ++column)
      if (!isColumnHidden(column)) cells << (*it)->text(column);
    lines << cells.join('\t');
  }
  QApplication::clipboard()->setText(lines.join('\n'));
}

}  // namespace capstan::widgets
