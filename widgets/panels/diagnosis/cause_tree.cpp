#include "widgets/panels/diagnosis/cause_tree.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>
#include <QTreeWidgetItemIterator>
#include <algorithm>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

namespace {

using diagnosis::Cause;

enum Column { kWords, kProbability, kColumns };
constexpr int kCauseRole = Qt::UserRole + 1, kNameRole = Qt::UserRole + 2;
constexpr double kPoints = 10.0;

QString shown(const std::string& words) { return QString::fromStdString(words); }

/// `text` wrapped between words into lines of at most `width` pixels.
QString wrapped(const QString& words, const QFontMetrics& metrics, int width) {
  QString lines, line;
  for (const QString& word : words.split(QLatin1Char(' '))) {
    const QString longer = line.isEmpty() ? word : line + QLatin1Char(' ') + word;
    if (!line.isEmpty() && metrics.horizontalAdvance(longer) > width) {
      lines += line + QLatin1Char('\n');
      line = word;
    } else {
      line = longer;
    }
  }
  return lines + line;
}

bool sameCause(const Cause& a, const Cause& b) { return a.effect == b.effect && a.joint == b.joint; }

/// Gain as "q2 on other data: 1.31 → 0.62 deg".
QString gainWords(const diagnosis::Gain& gain) {
  if (gain.channel.empty()) return {};
  const diagnosis::ShownUnit unit = diagnosis::shownUnit(gain.unit);
  return QObject::tr("%1 on other data: %2 → %3 %4")
      .arg(shown(gain.channel))
      .arg(unit.scale * gain.rms_before, 0, 'g', 3)
      .arg(unit.scale * gain.rms_after, 0, 'g', 3)
      .arg(shown(unit.unit));
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
  // Wraps the names to the present width.
  connect(header(), &QHeaderView::sectionResized, this, [this] { wrapNames(); });
  connect(this, &QTreeWidget::currentItemChanged, this, [this] { Q_EMIT chosenChanged(); });
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
  ties_ = report.ties;
  causes_.clear();
  const auto tied = [&](const Cause& cause) {
    return std::any_of(ties_.begin(), ties_.end(), [&](const diagnosis::Tie& tie) {
      return std::any_of(tie.causes.begin(), tie.causes.end(),
                         [&](const Cause& other) { return sameCause(cause, other); });
    });
  };
  for (const Cause& cause : report.causes)
    if (!tied(cause)) causes_.push_back(cause);
  alone_ = causes_.size();
  for (const diagnosis::Tie& tie : ties_) causes_.insert(causes_.end(), tie.causes.begin(), tie.causes.end());
  fill();
}

void CauseTree::fill() {
  const QSignalBlocker quiet(this);
  clear();
  for (std::size_t i = 0; i < alone_; ++i) addCause(nullptr, causes_[i]);
  for (const diagnosis::Tie& tie : ties_) {
    QTreeWidgetItem* group = addLine(nullptr, tr("One of these:"));
    for (const Cause& cause : tie.causes) addCause(group, cause);
  }
  if (causes_.empty())
    addLine(nullptr, verdict_ == diagnosis::Verdict::kUnexplained
                         ? tr("No hypothesis explains the residual; see the variables that it depends on.")
                         : tr("No material cause."));
  expandAll();
  wrapNames();
  QTreeWidgetItemIterator it(this);
  while (*it && !(*it)->data(0, kCauseRole).isValid()) ++it;
  setCurrentItem(*it);
}

QTreeWidgetItem* CauseTree::addLine(QTreeWidgetItem* parent, const QString& words) {
  auto* item = new QTreeWidgetItem;
  item->setText(kWords, words);
  item->setFont(kWords, textFont(kPoints - 0.5));
  item->setForeground(kWords, theme_.muted);
  item->setFlags(Qt::ItemIsEnabled);
  item->setToolTip(kWords, words);
  parent ? parent->addChild(item) : addTopLevelItem(item);
  item->setFirstColumnSpanned(true);
  return item;
}

void CauseTree::addCause(QTreeWidgetItem* parent, const Cause& cause) {
  auto* item = new QTreeWidgetItem;
  item->setData(kWords, kNameRole,
                titleOf(cause.effect) + QStringLiteral(", ") + placeOf(cause.effect, cause.joint, {}));
  item->setToolTip(kWords,
                   titleOf(cause.effect) + QStringLiteral(", ") + placeOf(cause.effect, cause.joint, robot_));
  item->setFont(kWords, textFont(kPoints, true));
  item->setText(kProbability, percentText(cause.probability));
  item->setFont(kProbability, numberFont(kPoints));
  item->setTextAlignment(kProbability, Qt::AlignRight | Qt::AlignVCenter);
  item->setToolTip(kProbability,
                   tr("Share of resampled recordings in which the cause ranks first, or is needed"));
  const auto found = std::find_if(causes_.begin(), causes_.end(),
                                  [&](const Cause& other) { return sameCause(other, cause); });
  item->setData(0, kCauseRole, static_cast<int>(found - causes_.begin()));
  ShareBar::set(*item, kProbability, cause.probability, theme_.accent);
  parent ? parent->addChild(item) : addTopLevelItem(item);
  for (const diagnosis::FoundParameter& parameter : cause.parameters) {
    QTreeWidgetItem* line = addLine(item, shown(diagnosis::shownParameter(parameter)));
    line->setFont(kWords, numberFont(kPoints - 0.5));
    line->setForeground(kWords, theme_.text);
  }
  if (const QString gain = gainWords(cause.gain); !gain.isEmpty())
    addLine(item, gain)->setToolTip(kWords, shown(diagnosis::gainText(cause.gain)));
}

void CauseTree::wrapNames() {
  constexpr int kMargins = 8;  // of an item [px]
  for (QTreeWidgetItemIterator it(this); *it; ++it) {
    QString name = (*it)->data(kWords, kNameRole).toString();
    if (name.isEmpty()) continue;
    name.replace(name.lastIndexOf(QLatin1Char(' ')), 1, QChar::Nbsp);  // "joint 1" in one line
    const int indent = (*it)->parent() ? indentation() : 0;
    (*it)->setText(kWords,
                   wrapped(name, QFontMetrics((*it)->font(kWords)), columnWidth(kWords) - indent - kMargins));
  }
}

const Cause* CauseTree::chosen() const {
  for (const QTreeWidgetItem* item = currentItem(); item; item = item->parent())
    if (const QVariant index = item->data(0, kCauseRole); index.isValid())
      return &causes_[static_cast<std::size_t>(index.toInt())];
  return nullptr;
}

QString CauseTree::text() const {
  QStringList lines;
  for (QTreeWidgetItemIterator it(const_cast<CauseTree*>(this)); *it; ++it) {
    int depth = 0;
    for (const QTreeWidgetItem* up = (*it)->parent(); up; up = up->parent()) ++depth;
    const QVariant name = (*it)->data(kWords, kNameRole);
    lines << (QString(2 * depth, QLatin1Char(' ')) +
              (name.isValid() ? name.toString() : (*it)->text(kWords)) + QLatin1Char(' ') +
              (*it)->text(kProbability))
                 .trimmed()
                 .prepend(QString(2 * depth, QLatin1Char(' ')));
  }
  return lines.join('\n');
}

void CauseTree::keyPressEvent(QKeyEvent* event) {
  if (!event->matches(QKeySequence::Copy)) return QTreeWidget::keyPressEvent(event);
  QApplication::clipboard()->setText(text());
}

}  // namespace capstan::widgets
