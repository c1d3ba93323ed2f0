#include "widgets/panels/registration/history_page.h"

#include <QBoxLayout>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVariant>
#include <algorithm>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/registration/registration_difference.h"
#include "core/vision/registration_file.h"

namespace capstan::widgets {
namespace {

using registration::Decision;
using registration::HistoryEntry;

constexpr double kSamePose = 1e-12;  // of numbers that were written and read to the last bit

QString shown(std::string_view text) { return QString::fromUtf8(text.data(), static_cast<int>(text.size())); }

/// "2026-11-28 18:19": the tooltip has the seconds.
QString dateOf(const HistoryEntry& entry) { return shown(entry.date).left(16).replace('T', ' '); }

QTableWidgetItem* cell(const QString& text, bool number = false) {
  auto* item = new QTableWidgetItem(text);
  item->setTextAlignment((number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
  item->setToolTip(text);
  return item;
}

}  // namespace

HistoryPage::HistoryPage(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  makeTable();
  comparison_ = new QLabel;
  comparison_->setWordWrap(true);
  comparison_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  comparison_->setMinimumHeight(3 * comparison_->fontMetrics().lineSpacing());  // so that nothing moves
  comparison_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  comparison_->setAccessibleName(tr("comparison"));
  fault_ = new QLabel;
  fault_->setWordWrap(true);
  fault_->setMargin(8);
  fault_->hide();
  column->addWidget(table_, 1);
  column->addWidget(comparison_);
  column->addWidget(fault_);
  column->addWidget(makeButtons());
  setTheme(theme_);
  refresh();
}

void HistoryPage::makeTable() {
  table_ = new QTableWidget(0, kColumns);
  table_->setHorizontalHeaderLabels(
      {tr("date"), tr("decision"), tr("method"), tr("RMS [mm]"), tr("points"), tr("reason")});
  table_->setAccessibleName(tr("history of registrations"));
  table_->horizontalHeaderItem(kResidual)->setToolTip(tr("RMS residual of the points used"));
  table_->horizontalHeaderItem(kPoints)->setToolTip(tr("Points used, and excluded"));
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(kReason, QHeaderView::Stretch);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  table_->setMinimumHeight(120);
  connect(table_, &QTableWidget::itemSelectionChanged, this, &HistoryPage::refresh);
}

QWidget* HistoryPage::makeButtons() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  import_ = new QPushButton(tr("Import…"));
  export_ = new QPushButton(tr("Export…"));
  export_->setToolTip(tr("Registration file, for a live set-up and for `capstan-cli track --register`"));
  restore_ = new QPushButton(tr("Restore"));
  restore_->setObjectName("restore");
  restore_->setProperty("primary", true);
  row->addWidget(import_);
  row->addWidget(export_);
  row->addStretch(1);
  row->addWidget(restore_);
  const QString kinds = tr("Registration files (*.yaml)");
  connect(import_, &QPushButton::clicked, this, [this, kinds] {
    auto* dialog = new QFileDialog(this, tr("Import a registration"), {}, kinds + tr(";;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, &HistoryPage::importFrom);
    dialog->open();
  });
  connect(export_, &QPushButton::clicked, this, [this, kinds] {
    auto* dialog = new QFileDialog(this, tr("Export the registration"), {}, kinds);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix("yaml");
    dialog->selectFile("registration.yaml");
    connect(dialog, &QFileDialog::fileSelected, this, &HistoryPage::exportTo);
    dialog->open();
  });
  connect(restore_, &QPushButton::clicked, this, &HistoryPage::restore);
  return box;
}

void HistoryPage::setTheme(const Theme& theme) {
  theme_ = theme;
  fault_->setStyleSheet(noticeStyle(theme, theme.fault));
}

void HistoryPage::setEntries(std::vector<HistoryEntry> entries) {
  entries_ = std::move(entries);
  table_->clearSelection();
  table_->setRowCount(static_cast<int>(entries_.size()));
  for (int row = 0; row < table_->rowCount(); ++row) fillRow(row);
  refresh();
}

void HistoryPage::setRobot(const std::optional<robot::Description>& robot) {
  robot_ = robot;
  refresh();
}

void HistoryPage::setCurrent(const std::optional<Eigen::Isometry3d>& current) {
  current_ = current;
  for (int row = 0; row < table_->rowCount(); ++row) fillRow(row);
  refresh();
}

void HistoryPage::showFault(const QString& fault) {
  fault_->setText(fault);
  fault_->setVisible(!fault.isEmpty());
}

QString HistoryPage::fault() const { return fault_->isHidden() ? QString() : fault_->text(); }
QString HistoryPage::comparison() const { return comparison_->text(); }

void HistoryPage::fillRow(int row) {
  const HistoryEntry& entry = entries_[entries_.size() - 1 - static_cast<std::size_t>(row)];
  const auto pose = entry.pose();
  const bool in_use = pose && current_ && pose->isApprox(*current_, kSamePose);
  table_->setItem(row, kDate, cell(dateOf(entry)));
  table_->item(row, kDate)->setToolTip(shown(entry.date).replace('T', ' '));
  table_->setItem(row, kDecision,
                  cell(shown(base::nameOf(entry.decision)) + (in_use ? tr(", in use") : QString())));
  table_->setItem(row, kMethod, cell(shown(base::nameOf(entry.method))));
  table_->setItem(
      row, kResidual,
      cell(entry.rms ? QString::number(base::toMillimetres(*entry.rms), 'f', 2) : QString("–"), true));
  table_->setItem(row, kPoints,
                  cell(entry.used == 0       ? QString("–")
                       : entry.excluded == 0 ? QString::number(entry.used)
                                             : tr("%1, %2 out").arg(entry.used).arg(entry.excluded),
                       true));
  auto* reason = cell(shown(entry.reason).simplified());
  reason->setToolTip(tr("%1\nrobot %2\nsession %3")
                         .arg(shown(entry.reason), shown(entry.robot), shown(entry.session))
                         .trimmed());
  table_->setItem(row, kReason, reason);
}

std::vector<std::size_t> HistoryPage::selected() const {
  std::vector<std::size_t> found;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows())
    found.push_back(entries_.size() - 1 - static_cast<std::size_t>(index.row()));
  std::ranges::sort(found);
  return found;
}

void HistoryPage::select(const std::vector<std::size_t>& entries) {
  table_->clearSelection();
  for (const std::size_t entry : entries) {
    const int row = table_->rowCount() - 1 - static_cast<int>(entry);
    table_->selectionModel()->select(table_->model()->index(row, 0),
                                     QItemSelectionModel::Select | QItemSelectionModel::Rows);
  }
}

const HistoryEntry* HistoryPage::chosen() const {
  const auto found = selected();
  return found.size() == 1 ? &entries_[found.front()] : nullptr;
}

QString HistoryPage::whyNotUsed() const {
  const HistoryEntry* entry = chosen();
  if (!entry) return tr("Select one registration");
  if (!entry->pose()) return tr("This one was rejected before there was a result");
  if (!robot_) return tr("Open a session first");
  if (entry->robot != robot_->name) return tr("It is of another robot: %1").arg(shown(entry->robot));
  if (current_ && entry->pose()->isApprox(*current_, kSamePose)) return tr("It is in use");
  return {};
}

QString HistoryPage::comparisonText() const {
  const auto found = selected();
  if (found.empty() || found.size() > 2)
    return tr(
        "Select one registration to compare it with the one in use, or two (Ctrl+click) to compare "
        "them with each other.");
  std::optional<Eigen::Isometry3d> from = current_, to = entries_[found.back()].pose();
  if (found.size() == 2) from = entries_[found.front()].pose();
  if (!to || (found.size() == 2 && !from)) return tr("There is nothing to compare: no result.");
  if (!from) return tr("No registration is in use. Select two to compare them with each other.");
  const QString head = found.size() == 2
                           ? tr("From %1 to %2: ").arg(dateOf(entries_[found[0]]), dateOf(entries_[found[1]]))
                           : tr("From the one in use to %1: ").arg(dateOf(entries_[found[0]]));
  const robot::Description robot = robot_ ? *robot_ : robot::defaultDescription();
  return head + QString::fromStdString(wordsOf(registration::differenceOf(*from, *to, robot))) + ".";
}

void HistoryPage::refresh() {
  comparison_->setText(comparisonText());
  const HistoryEntry* entry = chosen();
  export_->setEnabled(entry && entry->pose());
  import_->setEnabled(robot_.has_value());
  import_->setToolTip(robot_ ? tr("Puts the registration of a file in use") : tr("Open a session first"));
  const QString why = whyNotUsed();
  restore_->setEnabled(why.isEmpty());
  restore_->setToolTip(why.isEmpty() ? tr("Puts this registration in use again") : why);
}

void HistoryPage::restore() {
  const HistoryEntry* entry = chosen();
  if (!entry || !entry->pose()) return;
  HistoryEntry again = *entry;
  again.decision = Decision::kRestored;
  again.reason = tr("of %1").arg(shown(entry->date).replace('T', ' ')).toStdString();
  Q_EMIT useRequested(again);
}

void HistoryPage::exportTo(const QString& file) {
  const HistoryEntry* entry = chosen();
  if (!entry || !entry->pose()) return;
  showFault({});
  try {
    vision::writeRegistration(*entry->pose(), file.toStdString());
  } catch (const base::InputError& error) {
    showFault(QString::fromUtf8(error.what()));
  }
}

void HistoryPage::importFrom(const QString& file) {
  showFault({});
  HistoryEntry entry;
  try {
    entry.setPose(vision::readRegistration(file.toStdString()));
  } catch (const base::InputError& error) {
    return showFault(QString::fromUtf8(error.what()));
  }
  entry.decision = Decision::kImported;
  entry.method = registration::Method::kFile;
  entry.reason = file.toStdString();
  Q_EMIT useRequested(entry);
}

}  // namespace capstan::widgets
