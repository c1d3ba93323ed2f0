#include "widgets/panels/registration/poses_page.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QVariant>
#include <algorithm>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/registration/closure.h"
#include "core/registration/pair_words.h"
#include "core/tracking/transmission_text.h"

namespace capstan::widgets {
namespace {

QString millimetres(double metres, int digits = 2) {
  return QString::number(base::toMillimetres(metres), 'f', digits).replace('-', QStringLiteral("−"));
}

QTableWidgetItem* numberItem(const QString& text) {
  auto* item = new QTableWidgetItem(text);
  item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  return item;
}

/// Why poses by the robot file would mislead: what the augmented filter has found wrong in it; empty:
/// nothing.
QString wrongConstantsOf(const tracking::TransmissionEstimate& found) {
  bool wrong = false;
  for (const int joint : {0, 1, 2}) wrong |= found.includesScale(joint) || found.includesOffset(joint);
  return wrong ? QObject::tr(
                     "The filter finds the robot file wrong (%1), and the poses are computed with that "
                     "file. Identify the robot and accept the values before you accept this "
                     "registration; the poses are then computed again.")
                     .arg(QString::fromStdString(tracking::shortTextOf(found)))
               : QString();
}

}  // namespace

PosesPage::PosesPage(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  auto* advice = new QLabel(tr("Move the arm slowly through its whole workspace, in all three directions. A "
                               "pose is taken where the tip is "
                               "slower than %1 mm/s and %2 mm or more from every other pose.")
                                .arg(base::toMillimetres(registration::PoseCollector::kSlow))
                                .arg(base::toMillimetres(registration::PoseCollector::kApart)));
  advice->setWordWrap(true);
  collect_ = new QPushButton(tr("Collect poses"));
  collect_->setProperty("primary", true);
  clear_ = new QPushButton(tr("Clear"));
  save_ = new QPushButton(tr("Save poses…"));
  save_->setToolTip(tr("Table for `capstan-cli register`"));
  count_ = new QLabel;
  auto* top = new QHBoxLayout;
  top->addWidget(collect_);
  top->addWidget(clear_);
  top->addWidget(save_);
  top->addStretch(1);
  top->addWidget(count_);
  makeTable();
  result_ = new QLabel;
  result_->setFont(numberFont(10.5));
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  refusal_ = new QLabel;
  refusal_->setWordWrap(true);
  refusal_->setMargin(8);
  column->addWidget(advice);
  column->addLayout(top);
  column->addWidget(table_, 1);
  column->addWidget(result_);
  column->addWidget(refusal_);
  column->addWidget(makeDecision());
  connect(collect_, &QPushButton::clicked, this, [this] { setCollecting(!collector_->collecting()); });
  connect(clear_, &QPushButton::clicked, this, [this] {
    collector_->clear();
    refresh();
  });
  connect(save_, &QPushButton::clicked, this, &PosesPage::savePoses);
  setEnabled(false);
  setTheme(theme_);
}

PosesPage::~PosesPage() = default;

void PosesPage::makeTable() {
  table_ = new QTableWidget(0, kColumns);
  table_->setHorizontalHeaderLabels({tr("pose"), tr("x [mm]"), tr("y [mm]"), tr("z [mm]"),
                                     tr("residual [mm]"), tr("shift [mm]"), tr("state")});
  table_->setAccessibleName(tr("poses"));
  table_->horizontalHeaderItem(kResidual)->setToolTip(tr("Distance of the pose from the fit"));
  table_->horizontalHeaderItem(kShift)->setToolTip(
      tr("Largest displacement of the tip, at these poses, by the fit without this pose"));
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setStretchLastSection(true);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setMinimumHeight(120);
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (filling_ || item->column() != kPose) return;
    collector_->exclude(static_cast<std::size_t>(item->row()), item->checkState() != Qt::Checked);
    refresh();
  });
}

QWidget* PosesPage::makeDecision() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  check_ = new QPushButton(tr("Check at three more poses"));
  closures_ = new QLabel;
  closures_->setWordWrap(true);
  reason_ = new QComboBox;
  reason_->setEditable(true);
  reason_->addItems(
      {tr("closure error too large"), tr("too few poses"), tr("wrong thing detected"), tr("only a trial")});
  reason_->setCurrentIndex(-1);
  reason_->lineEdit()->setPlaceholderText(tr("reason to reject"));
  reason_->setMinimumWidth(160);
  reject_ = new QPushButton(tr("Reject"));
  accept_ = new QPushButton(tr("Accept"));
  accept_->setProperty("primary", true);
  auto* row = new QHBoxLayout;
  row->addWidget(check_);
  row->addStretch(1);
  row->addWidget(reason_, 2);
  row->addWidget(reject_);
  row->addSpacing(12);
  row->addWidget(accept_);
  column->addWidget(closures_);
  column->addLayout(row);
  connect(check_, &QPushButton::clicked, this, [this] {
    collector_->check();
    refresh();
  });
  connect(reason_, &QComboBox::editTextChanged, this, [this] { refresh(); });
  connect(reject_, &QPushButton::clicked, this, &PosesPage::reject);
  connect(accept_, &QPushButton::clicked, this, &PosesPage::accept);
  return box;
}

void PosesPage::accept() {
  const auto entry = registration::entryOf(registration::Decision::kAccepted, *collector_->fit());
  current_ = entry.pose();
  setCollecting(false);
  Q_EMIT accepted(*current_, summary());
  Q_EMIT decided(entry);
}

void PosesPage::reject() {
  using registration::Decision;
  registration::HistoryEntry entry;
  if (collector_->fit()) entry = registration::entryOf(Decision::kRejected, *collector_->fit());
  entry.decision = Decision::kRejected;
  const QString reason = reason_->currentText().trimmed();
  entry.reason = reason.toStdString();
  collector_->clear();
  reason_->clearEditText();
  refresh();
  Q_EMIT rejected(reason);
  Q_EMIT decided(entry);
}

void PosesPage::setTheme(const Theme& theme) {
  theme_ = theme;
  refusal_->setStyleSheet(noticeStyle(theme, theme.warning));
  closures_->setStyleSheet(QString("color:%1;").arg(theme.muted.name()));
}

void PosesPage::begin(const robot::Description& robot, const std::optional<Eigen::Isometry3d>& current) {
  collector_ = std::make_unique<registration::PoseCollector>(robot);
  current_ = current;
  setEnabled(true);
  refresh();
}

void PosesPage::setRobot(const robot::Description& robot) {
  if (!collector_) return;
  collector_->setRobot(robot);
  wrong_constants_.clear();
  refresh();
}

void PosesPage::showSnapshot(const tracking::Snapshot& snapshot) {
  if (!active()) return;
  const QString wrong = wrongConstantsOf(snapshot.transmission);
  const bool changed = wrong.isEmpty() != wrong_constants_.isEmpty();
  wrong_constants_ = wrong;
  if (collector_->observe(snapshot) || changed) refresh();
}

void PosesPage::setEnded(bool ended) {
  ended_ = ended;
  if (collector_) refresh();
}

void PosesPage::stop() {
  if (collector_) setCollecting(false);
}

bool PosesPage::active() const { return collector_ && (collector_->collecting() || collector_->checking()); }

QString PosesPage::summary() const { return result_->text(); }

void PosesPage::setCollecting(bool on) {
  collector_->setCollecting(on);
  refresh();
}

void PosesPage::refresh() {
  fillTable();
  const auto& fit = collector_->fit();
  const auto poses = collector_->poses().size();
  const auto used = fit ? std::ranges::count(fit->used, true) : 0;
  count_->setText(tr("%1 poses, %2 used").arg(poses).arg(used));
  collect_->setText(collector_->collecting() ? tr("Stop")
                    : poses > 0              ? tr("Collect more")
                                             : tr("Collect poses"));
  collect_->setEnabled(!ended_ || collector_->collecting());
  clear_->setEnabled(poses > 0);
  save_->setEnabled(poses > 0);
  check_->setEnabled((fit || current_) && !ended_);
  accept_->setEnabled(fit.has_value());
  reject_->setEnabled(poses > 0 && !reason_->currentText().trimmed().isEmpty());
  result_->setVisible(fit.has_value());
  if (fit) {
    result_->setText(resultText());
    refusal_->setText(QString::fromStdString(registration::warningOf(*fit)));
  } else {
    const auto words = registration::wordsOf(fit.error());
    refusal_->setText(QString::fromStdString(words.reason + ". " + words.remedy + "."));
  }
  if (!wrong_constants_.isEmpty()) refusal_->setText(wrong_constants_);  // it explains the residuals
  refusal_->setVisible(poses > 0 && !refusal_->text().isEmpty());
  closures_->setText(closureText());
}

void PosesPage::fillTable() {
  filling_ = true;
  const int rows = static_cast<int>(collector_->poses().size());
  const bool grown = rows > table_->rowCount();
  table_->setRowCount(rows);
  for (int row = 0; row < rows; ++row) fillRow(row);
  if (grown) table_->scrollToBottom();
  filling_ = false;
}

void PosesPage::fillRow(int row) {
  const auto index = static_cast<std::size_t>(row);
  const auto& pose = collector_->poses()[index];
  auto* name = numberItem(QString::number(row + 1));
  name->setFlags(name->flags() | Qt::ItemIsUserCheckable);
  name->setCheckState(pose.excluded ? Qt::Unchecked : Qt::Checked);
  table_->setItem(row, kPose, name);
  for (int axis = 0; axis < 3; ++axis)
    table_->setItem(row, kX + axis, numberItem(millimetres(pose.pair.base(axis), 1)));
  QString residual = "–", shift = "–", state = pose.excluded ? tr("excluded") : tr("no fit");
  const auto& fit = collector_->fit();
  const auto& fitted = collector_->fitted();
  const auto at = static_cast<std::size_t>(std::ranges::find(fitted, index) - fitted.begin());
  if (fit) residual = millimetres((fit->base_from_camera * pose.pair.camera - pose.pair.base).norm());
  if (fit && at < fitted.size()) {
    shift = fit->used[at] ? millimetres(fit->shifts[at]) : "–";
    state = fit->used[at] ? tr("used") : tr("outlier");
  }
  table_->setItem(row, kResidual, numberItem(residual));
  table_->setItem(row, kShift, numberItem(shift));
  table_->setItem(row, kVerdict, numberItem(state));
}

QString PosesPage::resultText() const {
  const auto& fit = *collector_->fit();
  const auto line = [](const QString& name, const QString& value) { return name.leftJustified(24) + value; };
  const Eigen::Vector3d place = fit.base_from_camera.translation();
  QStringList lines = {line(
      tr("base_from_camera"),
      QString("%1, %2, %3 mm").arg(millimetres(place.x()), millimetres(place.y()), millimetres(place.z())))};
  if (current_) {
    const Eigen::AngleAxisd turn(fit.base_from_camera.rotation() * current_->rotation().transpose());
    double moved = 0.0;
    for (const auto& pose : collector_->poses())
      moved = std::max(
          moved, ((fit.base_from_camera.inverse() * pose.pair.base) - (current_->inverse() * pose.pair.base))
                     .norm());
    lines << line(tr("from the one in use"), tr("turned %1°, tip moved up to %2 mm")
                                                 .arg(base::toDegrees(std::abs(turn.angle())), 0, 'f', 2)
                                                 .arg(millimetres(moved)));
  }
  lines << line(tr("residual, leave-one-out"),
                tr("%1 mm, %2 mm RMS").arg(millimetres(fit.rms), millimetres(fit.leave_one_out_rms)));
  const auto error = collector_->workspaceError();
  lines << line(tr("95 % error, workspace"),
                tr("%1 mm, %2 mm at its far end").arg(millimetres(error.median), millimetres(error.largest)));
  return lines.join('\n');
}

QString PosesPage::closureText() const {
  const auto& checks = collector_->checks();
  if (collector_->checking())
    return tr("Move the arm: %1 of %2 poses").arg(checks.size()).arg(registration::PoseCollector::kChecks);
  if (checks.empty())
    return tr("Compares the %1 with three poses that are not in it")
        .arg(collector_->fit() ? tr("fit") : tr("registration in use"));
  const auto closures = collector_->fit() ? registration::closuresOf(*collector_->fit(), checks)
                                          : registration::closuresOf(*current_, checks);
  QStringList errors;
  for (const auto& closure : closures) errors << millimetres(closure.error);
  return tr("%1 mm. %2.")
      .arg(errors.join(", "), QString::fromStdString(registration::closureWords(closures)));
}

void PosesPage::savePoses() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save poses"), "poses.csv", tr("Tables (*.csv)"));
  if (file.isEmpty()) return;
  try {
    collector_->save(file.toStdString());
  } catch (const base::InputError& error) {
    refusal_->setText(QString::fromUtf8(error.what()));
    refusal_->show();
  }
}

}  // namespace capstan::widgets
