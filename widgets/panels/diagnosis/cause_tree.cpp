#include "widgets/panels/diagnosis/cause_tree.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <QTreeWidgetItemIterator>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/table_font.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {

namespace {

using diagnosis::Cause;

enum Column { kWords, kProbability, kColumns };
constexpr int kCauseRole = Qt::UserRole + 1;

QString shown(const std::string& words) { return QString::fromStdString(words); }

/// Gain as "q2 on held-out data: 1.31 → 0.62 deg".
QString gainWords(const diagnosis::Gain& gain) {
  if (gain.channel.empty()) return {};
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(gain.unit);
  return QObject::tr("%1 on held-out data: %2 → %3 %4")
      .arg(shown(gain.channel))
      .arg(unit.scale * gain.rms_before, 0, 'g', 3)
      .arg(unit.scale * gain.rms_after, 0, 'g', 3)
      .arg(shown(unit.unit));
}

QString probabilityTip(const Cause& cause) {
  QString tip = QObject::tr("Posterior probability that the effect belongs to the model");
  if (cause.loss > 0.0)
    tip += QObject::tr("; without it, the log predictive density of held-out data falls by %1 nats")
               .arg(cause.loss, 0, 'g', 3);
  return tip;
}

}  // namespace

CauseTree::CauseTree(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("causes");
  setColumnCount(kColumns);
  setHeaderLabels({tr("cause"), tr("probability")});
  setItemDelegateForColumn(kProbability, new ShareBar(this));
  setIndentation(14);
  setRootIsDecorated(false);
  setItemsExpandable(false);
  setFrameShape(QFrame::NoFrame);
  setWordWrap(true);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setAccessibleName(tr("causes found"));
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(10);
  header()->setSectionResizeMode(kWords, QHeaderView::Stretch);
  header()->setSectionResizeMode(kProbability, QHeaderView::Fixed);
  header()->resizeSection(kProbability, 84);
  header()->setFont(textFont(9.0));
  connect(header(), &QHeaderView::sectionResized, this, [this] { wrapWords(*this, kWords); });
  connect(this, &QTreeWidget::currentItemChanged, this, [this] { Q_EMIT chosenChanged(); });
  connect(this, &QTreeWidget::itemClicked, this, [this](const QTreeWidgetItem* item) {
    if (item == folded_) setUnfolded(!unfolded_);
  });
}

void CauseTree::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 1px 0; } "
                               "QTreeWidget::item:selected { background: %1; color: %2; } "
                               "QTreeWidget::branch { image: none; border-image: none; background: %3; }")
                    .arg(theme.raised.name(), theme.text.name(), theme.surface.name()));
  fill();
}

void CauseTree::showReport(const diagnosis::Report& report) {
  verdict_ = report.verdict;
  robot_ = report.extended;
  causes_.clear();
  groups_.clear();
  for (const Cause& cause : report.causes) {
    const diagnosis::Tie* tie = diagnosis::tieOfCause(report, cause);
    const std::vector<Cause> group = tie ? diagnosis::mostProbableFirst(*tie) : std::vector{cause};
    causes_.insert(causes_.end(), group.begin(), group.end());
    groups_.push_back(group.size());
  }
  causes_.insert(causes_.end(), report.also_measurable.begin(), report.also_measurable.end());
  also_ = report.also_measurable.empty() ? QString()
                                         : tr("%1 (%2)")
                                               .arg(shown(diagnosis::alsoMeasurableTitle(report)))
                                               .arg(report.also_measurable.size());
  fill();
}

void CauseTree::fill() {
  const QSignalBlocker quiet(this);
  clear();
  folded_ = nullptr;
  std::size_t next = 0;
  for (const std::size_t size : groups_) {
    QTreeWidgetItem* tie =
        size > 1 ? addLine(nullptr, tr("One of these (probabilities relative to each other):")) : nullptr;
    for (std::size_t i = 0; i < size; ++i) addCause(tie, next++);
  }
  if (next == 0)
    addLine(nullptr,
            verdict_ == diagnosis::Verdict::kUnexplained
                ? tr("No hypothesis explains the residual; see the variables that it depends on.")
            : also_.isEmpty()
                ? tr("No material cause.")
                : tr("No cause above the tolerance. With a smaller one, what is measurable is a cause."));
  QTreeWidgetItem* first = nullptr;
  for (QTreeWidgetItemIterator it(this); *it && !first; ++it)
    if ((*it)->data(0, kCauseRole).isValid()) first = *it;
  if (!also_.isEmpty()) {
    folded_ = addLine(nullptr, also_);
    folded_->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
    while (next < causes_.size()) addCause(folded_, next++);
  }
  const bool small_only = !first && folded_;  // then the small ones are all there is to see
  if (small_only) first = folded_->child(0);
  expandAll();
  setUnfolded(unfolded_ || small_only);
  setCurrentItem(first);
  scrollToTop();
}

void CauseTree::setUnfolded(bool unfolded) {
  unfolded_ = unfolded;
  if (folded_) {
    folded_->setExpanded(unfolded);
    setWords(*folded_, kWords, (unfolded ? QStringLiteral("▾ ") : QStringLiteral("▸ ")) + also_);
  }
  wrapWords(*this, kWords);
}

QTreeWidgetItem* CauseTree::addLine(QTreeWidgetItem* parent, const QString& words) {
  auto* item = new QTreeWidgetItem;
  setWords(*item, kWords, words);
  item->setFont(kWords, textFont(kTableFont - 0.5));
  item->setForeground(kWords, theme_.muted);
  item->setFlags(Qt::ItemIsEnabled);
  item->setToolTip(kWords, words);
  parent ? parent->addChild(item) : addTopLevelItem(item);
  item->setFirstColumnSpanned(true);
  return item;
}

QTreeWidgetItem* CauseTree::addTitle(QTreeWidgetItem* parent, const Cause& cause) {
  auto* item = new QTreeWidgetItem;
  const QString title = titleOf(cause.effect);
  QString place = placeAfterTitle(cause.effect, cause.joint, {});
  if (!place.isEmpty()) place = place.left(2) + place.mid(2).replace(QLatin1Char(' '), QChar(QChar::Nbsp));
  setWords(*item, kWords, title + place);  // the place in one line
  item->setToolTip(kWords, title + placeAfterTitle(cause.effect, cause.joint, robot_));
  item->setFont(kWords, textFont(kTableFont, true));
  item->setText(kProbability, percentText(cause.probability));
  item->setFont(kProbability, numberFont(kTableFont));
  item->setTextAlignment(kProbability, Qt::AlignRight | Qt::AlignVCenter);
  item->setToolTip(kProbability, probabilityTip(cause));
  ShareBar::set(*item, kProbability, cause.probability, theme_.accent);
  parent ? parent->addChild(item) : addTopLevelItem(item);
  return item;
}

void CauseTree::addCause(QTreeWidgetItem* parent, std::size_t index) {
  const Cause& cause = causes_[index];
  QTreeWidgetItem* item = addTitle(parent, cause);
  item->setData(0, kCauseRole, static_cast<int>(index));
  for (const diagnosis::FoundParameter& parameter : cause.parameters) {
    QTreeWidgetItem* line = addLine(item, shown(diagnosis::shownParameter(cause.effect, parameter)));
    line->setFont(kWords, numberFont(kTableFont - 0.5));
    line->setForeground(kWords, theme_.text);
  }
  if (!cause.moves.joints.empty()) addLine(item, shown(diagnosis::movesText(cause)));
  if (const QString gain = gainWords(cause.gain); !gain.isEmpty())
    addLine(item, gain)->setToolTip(kWords, shown(diagnosis::gainText(cause.gain)));
}

const Cause* CauseTree::chosen() const {
  const auto causeOf = [this](const QTreeWidgetItem* item) {
    const QVariant index = item ? item->data(0, kCauseRole) : QVariant();
    return index.isValid() ? &causes_[static_cast<std::size_t>(index.toInt())] : nullptr;
  };
  for (const QTreeWidgetItem* item = currentItem(); item; item = item->parent())
    if (const Cause* cause = causeOf(item)) return cause;
  return currentItem() ? causeOf(currentItem()->child(0)) : nullptr;
}

QString CauseTree::text() const {
  QStringList lines;
  for (QTreeWidgetItemIterator it(const_cast<CauseTree*>(this)); *it; ++it) {
    int depth = 0;
    for (const QTreeWidgetItem* up = (*it)->parent(); up; up = up->parent()) ++depth;
    QString line = wordsOf(**it, kWords) + QLatin1Char(' ') + (*it)->text(kProbability);
    lines << QString(2 * depth, QLatin1Char(' ')) +
                 line.replace(QChar(QChar::Nbsp), QLatin1Char(' ')).trimmed();
  }
  return lines.join('\n');
}

void CauseTree::keyPressEvent(QKeyEvent* event) {
  if (event->matches(QKeySequence::Copy)) return QApplication::clipboard()->setText(text());
  const int key = event->key();
  if (folded_ && currentItem() == folded_ &&
      (key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter))
    return setUnfolded(!unfolded_);
  QTreeWidget::keyPressEvent(event);
}

}  // namespace capstan::widgets
