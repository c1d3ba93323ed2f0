#include "widgets/panels/diagnosis/refit_table.h"

#include <QHeaderView>
#include <algorithm>
#include <limits>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/number_text.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {

namespace {

constexpr double kPoints = 10.0;

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
  numbers_ = report.refit;
  std::stable_partition(numbers_.begin(), numbers_.end(), [](const auto& number) { return number.moved; });
  fill();
}

void RefitTable::fill() {
  clear();
  setHeaderLabels({tr("parameter"), tr("robot file"), tr("without effects"),
                   effects_ ? tr("with effects") : tr("refitted"), tr("change")});
  setColumnHidden(kWithout, !effects_);
  for (const diagnosis::RefitNumber& number : numbers_) addNumber(number);
  for (const int column : {kNominal, kWithout, kValue, kChange}) resizeColumnToContents(column);
  fitNames();
  wrapWords(*this, kName);
}

void RefitTable::addNumber(const diagnosis::RefitNumber& number) {
  const double change =
      number.nominal != 0.0 ? number.value / number.nominal - 1.0 : std::numeric_limits<double>::quiet_NaN();
  QString changed = percentText(change, 1, true);
  if (number.at_bound) changed += tr("\nat its bound");
  auto* item = new QTreeWidgetItem({QString(), shown(number.nominal, 0.0, number.unit),
                                    shown(number.value_without, 0.0, number.unit),
                                    shown(number.value, number.sigma, number.unit), changed});
  setWords(*item, kName, nameOf(number));
  const QString tip = number.at_bound ? tr("It would go further than the refit allows")
                      : number.moved  ? tr("Changed by more than two standard deviations")
                                      : tr("Changed by less than two standard deviations");
  for (int column = 0; column < kColumns; ++column) {
    const bool bold = number.moved && (column == kName || column == kValue);
    item->setFont(column, column == kName ? textFont(kPoints, bold) : numberFont(kPoints, bold));
    item->setForeground(column, number.moved ? theme_.text : theme_.muted);
    if (column != kName) item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(column, tip);
  }
  if (number.at_bound) item->setFont(kChange, numberFont(kPoints, true));
  addTopLevelItem(item);
}

}  // namespace capstan::widgets
