#include "widgets/panels/diagnosis/posterior_table.h"

#include <QHeaderView>

#include "core/diagnosis/report/report_tables.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/table_font.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {

namespace {

constexpr std::size_t kMost = 24;  ///< sets shown
constexpr int kBarShare = 40;      ///< of the width [%]

}  // namespace

PosteriorTable::PosteriorTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("posterior");
  setColumnCount(kColumns);
  setHeaderLabels({tr("set of effects"), tr("probability")});
  headerItem()->setToolTip(kProbability,
                           tr("Posterior probability that the model has exactly these effects, averaged over "
                              "block bootstraps of the recordings"));
  headerItem()->setTextAlignment(kProbability, Qt::AlignRight | Qt::AlignVCenter);
  setItemDelegateForColumn(kProbability, new ShareBar(this));
  setRootIsDecorated(false);
  setFrameShape(QFrame::NoFrame);
  setAllColumnsShowFocus(true);
  setAccessibleName(tr("posterior over sets of effects"));
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(10);
  header()->setFont(textFont(9.0));
  header()->setSectionResizeMode(kEffects, QHeaderView::Stretch);
  header()->setSectionResizeMode(kProbability, QHeaderView::Fixed);
  connect(header(), &QHeaderView::sectionResized, this, [this] { wrapWords(*this, kEffects); });
}

void PosteriorTable::resizeEvent(QResizeEvent* event) {
  QTreeWidget::resizeEvent(event);
  header()->resizeSection(kProbability, kBarShare * viewport()->width() / 100);
}

void PosteriorTable::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 3px 4px; } "
                               "QTreeWidget::item:selected { background: %1; color: %2; }")
                    .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void PosteriorTable::showReport(const diagnosis::Report& report) {
  table_ = report.posterior.empty() ? base::Table{} : diagnosis::posteriorTable(report, kMost);
  if (report.posterior.empty()) table_.note = "This report has no posterior over sets of effects.";
  fill();
}

void PosteriorTable::fill() {
  clear();
  for (const std::vector<base::TableCell>& row : table_.rows) {
    const double share = row[kProbability].number / 100.0;
    auto* item = new QTreeWidgetItem;
    setWords(*item, kEffects, QString::fromStdString(row[kEffects].text));
    item->setText(kProbability, percentText(share, 1));
    item->setFont(kEffects, textFont(kTableFont));
    item->setFont(kProbability, numberFont(kTableFont));
    item->setTextAlignment(kProbability, Qt::AlignRight | Qt::AlignVCenter);
    ShareBar::set(*item, kProbability, share, theme_.accent);
    addTopLevelItem(item);
  }
  if (!table_.note.empty()) addNote(QString::fromStdString(table_.note));
  wrapWords(*this, kEffects);
}

void PosteriorTable::addNote(const QString& words) {
  auto* item = new QTreeWidgetItem;
  setWords(*item, kEffects, words);
  item->setFont(kEffects, textFont(kTableFont - 0.5));
  item->setForeground(kEffects, theme_.muted);
  item->setFlags(Qt::ItemIsEnabled);
  addTopLevelItem(item);
  item->setFirstColumnSpanned(true);
}

QStringList PosteriorTable::lines() const {
  QStringList lines;
  for (std::size_t i = 0; i < table_.rows.size(); ++i) {
    const QTreeWidgetItem& item = *topLevelItem(static_cast<int>(i));
    lines << wordsOf(item, kEffects) + QStringLiteral(" | ") + item.text(kProbability);
  }
  return lines;
}

}  // namespace capstan::widgets
