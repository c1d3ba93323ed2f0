#include "widgets/panels/diagnosis/refit_table.h"

#include <QHeaderView>
#include <algorithm>
#include <limits>

#include "core/diagnosis/report/shown.h"
#include "widgets/figures/number_text.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

namespace {

constexpr double kPoints = 10.0;

QString shown(double value, double sigma, const std::string& unit) {
  return withMinus(QString::fromStdString(diagnosis::shownNumber(value, sigma, unit)));
}

}  // namespace

RefitTable::RefitTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName("refit");
  setColumnCount(kColumns);
  setHeaderLabels({tr("parameter"), tr("robot file"), tr("refitted"), tr("change"), QString()});
  headerItem()->setToolTip(kValue, tr("Fitted before the search for causes, ± standard deviation"));
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setAllColumnsShowFocus(true);
  setAccessibleName(tr("parameters changed by the refit"));
  header()->setStretchLastSection(false);
  header()->setMinimumSectionSize(10);
  header()->setFont(textFont(9.0));
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kRemark, QHeaderView::Stretch);
  for (const int column : {kNominal, kValue, kChange})
    headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
}

void RefitTable::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 2px 6px; } "
                               "QTreeWidget::item:selected { background: %1; color: %2; }")
                    .arg(theme.raised.name(), theme.text.name()));
  fill();
}

void RefitTable::showReport(const diagnosis::Report& report) {
  numbers_ = report.refit;
  std::stable_partition(numbers_.begin(), numbers_.end(), [](const auto& number) { return number.moved; });
  fill();
}

void RefitTable::fill() {
  clear();
  for (const diagnosis::RefitNumber& number : numbers_) {
    const double change = number.nominal != 0.0 ? number.value / number.nominal - 1.0
                                                : std::numeric_limits<double>::quiet_NaN();
    auto* item = new QTreeWidgetItem(
        {QString::fromStdString(diagnosis::shownName(number.name)), shown(number.nominal, 0.0, number.unit),
         shown(number.value, number.sigma, number.unit), percentText(change, 1, true),
         number.at_bound ? tr("at its bound: it would go further")
         : number.moved  ? tr("moved")
                         : QString()});
    for (int column = 0; column < kColumns; ++column) {
      const bool words = column == kName || column == kRemark;
      item->setFont(column, words ? textFont(kPoints, number.moved && column == kName)
                                  : numberFont(kPoints, number.moved && column == kValue));
      item->setForeground(column, number.moved ? theme_.text : theme_.muted);
      if (!words) item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    }
    if (number.at_bound) item->setFont(kRemark, textFont(kPoints, true));
    addTopLevelItem(item);
  }
}

}  // namespace capstan::widgets
