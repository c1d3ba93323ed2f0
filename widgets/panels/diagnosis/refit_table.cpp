#include "widgets/panels/diagnosis/refit_table.h"

#include <QHeaderView>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/number_text.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/table_font.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {

namespace {

/// Number in the unit that stands beside the name.
QString shown(double value, double sigma, const std::string& si) {
  const diagnosis::ShownUnit unit{diagnosis::shownUnit(si).scale, {}};
  return withMinus(QString::fromStdString(diagnosis::shownNumber(value, sigma, unit)));
}

QString nameOf(const diagnosis::RefitNumber& number) {
  const std::string unit = diagnosis::shownUnit(number.unit).unit;
  return QString::fromStdString(diagnosis::shownName(number.name) + (unit.empty() ? "" : " [" + unit + "]"));
}

}  // namespace

RefitTable::RefitTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("refit");
  setColumnCount(kColumns);
  headerItem()->setToolTip(kWithout, tr("Fitted to the nominal structure, without any effect"));
  headerItem()->setToolTip(kValue, tr("Fitted together with the effects of the model, ± standard deviation"));
  setRootIsDecorated(false);
  setFrameShape(QFrame::NoFrame);
  setAllColumnsShowFocus(true);
  setAccessibleName(tr("parameters changed by the refit"));
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(10);
  header()->setFont(textFont(9.0));
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kName, QHeaderView::Fixed);
  connect(header(), &QHeaderView::sectionResized, this, [this] { wrapWords(*this, kName); });
  for (const int column : {kNominal, kWithout, kValue, kChange})
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
}

/// The names take what the numbers leave; where that is too little for a word, the table scrolls.
void RefitTable::resizeEvent(QResizeEvent* event) {
  QTreeWidget::resizeEvent(event);
  fitNames();
}

void RefitTable::fitNames() {
  constexpr int kLeastWidth = 110;  // px
  int numbers = 0;
  for (int column = 0; column < kColumns; ++column)
    if (column != kName && !isColumnHidden(column)) numbers += columnWidth(column);
  header()->resizeSection(kName, std::max(kLeastWidth, viewport()->width() - numbers));
}

void RefitTable::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 2px 6px; } "
                               "QTreeWidget::item:selected { background: %1; color: %2; }")
                    .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void RefitTable::showReport(const diagnosis::Report& report) {
  effects_ = diagnosis::hasEffects(report);
  numbers_ = diagnosis::refitInOrder(report);
  tolerance_ = report.material;
  fill();
}

void RefitTable::fill() {
  clear();
  setHeaderLabels({tr("parameter"), tr("robot file"), tr("without effects"),
                   effects_ ? tr("with effects") : tr("refitted"), tr("change")});
  setColumnHidden(kWithout, !effects_);
  if (!numbers_.empty()) addLegend();
  for (const diagnosis::RefitNumber& number : numbers_) addNumber(number);
  for (const int column : {kNominal, kWithout, kValue, kChange}) resizeColumnToContents(column);
  fitNames();
  wrapWords(*this, kName);
  scrollToTop();
}

/// Why the number is emphasised, or not.
QString RefitTable::tipOf(const diagnosis::RefitNumber& number) const {
  const QString sigmas = number.sigma > 0.0
                             ? tr(" (%1 standard deviations)")
                                   .arg(std::abs(number.value - number.nominal) / number.sigma, 0, 'f', 1)
                             : QString();
  const QString remark = QString::fromStdString(diagnosis::refitRemark(number, tolerance_)) + sigmas;
  return number.material
             ? tr("Bold: changed by more than two standard deviations, and the change alone moves a "
                  "joint by more than the tolerance; %1")
                   .arg(remark)
             : remark;
}

void RefitTable::addLegend() {
  auto* legend = new QTreeWidgetItem;
  setWords(
      *legend, kName,
      tr("Bold: changed by more than two standard deviations, and the change alone moves a joint by more "
         "than the tolerance. Grey: changed by less than two standard deviations. The others differ, and "
         "it hardly matters to the joints."));
  legend->setFlags(Qt::ItemIsEnabled);
  legend->setForeground(kName, theme_.muted);
  legend->setFont(kName, textFont(kTableFont - 0.5));
  addTopLevelItem(legend);
  legend->setFirstColumnSpanned(true);
}

void RefitTable::addNumber(const diagnosis::RefitNumber& number) {
  QString changed = QString::fromStdString(diagnosis::refitChange(number));
  if (number.at_bound) changed += tr("\nat its bound");
  auto* item = new QTreeWidgetItem({QString(), shown(number.nominal, 0.0, number.unit),
                                    shown(number.value_without, 0.0, number.unit),
                                    shown(number.value, number.sigma, number.unit), changed});
  setWords(*item, kName, nameOf(number));
  const QString tip = tipOf(number);
  const QColor colour = number.moved ? theme_.text : theme_.muted;
  for (int column = 0; column < kColumns; ++column) {
    const bool bold = number.material && column != kNominal && column != kWithout;
    item->setFont(column, column == kName ? textFont(kTableFont, bold) : numberFont(kTableFont, bold));
    item->setForeground(column, colour);
    if (column != kName) item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(column, tip);
  }
  addTopLevelItem(item);
}

}  // namespace capstan::widgets
