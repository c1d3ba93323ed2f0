#include "widgets/panels/registration/poses_page.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QFileDialog>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QTableWidget>
#include <QVariant>
#include <algorithm>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/registration/pair_words.h"
#include "widgets/panels/registration/poses_text.h"

namespace capstan::widgets {
namespace {

QTableWidgetItem* numberItem(const QString& text) {
  auto* item = new QTableWidgetItem(text);
  item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  return item;
}

constexpr int kTableShare = 3, kTextShare = 2;     ///< of the height that is left for both
constexpr int kCheckLines = 4;                     ///< of the longest result of a check, in a narrow dock
constexpr int kLeastTable = 90, kLeastTexts = 60;  ///< [px]

/// Texts of the button that collects: without poses, with poses, while it collects.
QStringList collectWords() {
  return {QObject::tr("Collect poses"), QObject::tr("Collect more"), QObject::tr("Stop")};
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
  makeTable();
  column->addWidget(advice);
  column->addWidget(table_, kTableShare);
  column->addWidget(makeTexts(), kTextShare);
  column->addLayout(makeCollection());
  column->addWidget(makeDecision());
  setEnabled(false);
  setTheme(theme_);
}

PosesPage::~PosesPage() = default;

/// Texts of any length in a place of fixed height, so that the buttons below stay where they are.
QWidget* PosesPage::makeTexts() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  for (QLabel** notice : {&origin_, &robot_warning_, &refusal_}) {
    *notice = new QLabel;
    (*notice)->setWordWrap(true);
    (*notice)->setMargin(6);
    column->addWidget(*notice);
  }
  result_ = new QLabel;
  result_->setFont(numberFont(10.5));
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(result_);
  column->addStretch(1);
  texts_ = new QScrollArea;
  texts_->setWidgetResizable(true);
  texts_->setFrameShape(QFrame::NoFrame);
  texts_->setMinimumHeight(kLeastTexts);
  texts_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);  // else the page grows with the texts
  texts_->setAccessibleName(tr("result of the poses"));
  texts_->setWidget(box);
  texts_->viewport()->setAutoFillBackground(false);
  box->setAutoFillBackground(false);
  return texts_;
}

QLayout* PosesPage::makeCollection() {
  collect_ = new QPushButton(collectWords()[0]);
  collect_->setProperty("primary", true);
  clear_ = new QPushButton(tr("Clear"));
  save_ = new QPushButton(tr("Save poses…"));
  save_->setToolTip(tr("Table for `capstan-cli register`"));
  count_ = new QLabel;
  auto* row = new QHBoxLayout;
  row->addWidget(collect_);
  row->addWidget(clear_);
  row->addWidget(save_);
  row->addStretch(1);
  row->addWidget(count_);
  connect(collect_, &QPushButton::clicked, this, [this] { setCollecting(!collector_->collecting()); });
  connect(clear_, &QPushButton::clicked, this, &PosesPage::clear);
  connect(save_, &QPushButton::clicked, this, &PosesPage::save);
  return row;
}

/// The button that collects and stops keeps the width of its longest text.
void PosesPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  const QString now = collect_->text();
  int widest = 0;
  for (const QString& words : collectWords()) {
    collect_->setText(words);
    widest = std::max(widest, collect_->sizeHint().width());
  }
  collect_->setText(now);
  collect_->setMinimumWidth(widest);
  closures_->setFixedHeight(kCheckLines * closures_->fontMetrics().lineSpacing());
}

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
  table_->setMinimumHeight(kLeastTable);
  table_->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Ignored);
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
  closures_->setAlignment(Qt::AlignLeft | Qt::AlignBottom);
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
  unsaved_ = false;
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
  reason_->clearEditText();
  clear();
  Q_EMIT rejected(reason);
  Q_EMIT decided(entry);
}

void PosesPage::setTheme(const Theme& theme) {
  theme_ = theme;
  for (QLabel* notice : {origin_, robot_warning_, refusal_})
    notice->setStyleSheet(noticeStyle(theme, theme.warning));
  closures_->setStyleSheet(QString("color:%1;").arg(theme.muted.name()));
}

void PosesPage::begin(const robot::Description& robot, const std::optional<Eigen::Isometry3d>& current,
                      const QString& taken) {
  const bool kept = collector_ && !collector_->poses().empty() && (taken.isEmpty() || unsaved_);
  if (!kept) {
    collector_ = std::make_unique<registration::PoseCollector>(robot);
    unsaved_ = false;
    fault_.clear();
  }
  collector_->stop();
  taken_ = kept ? taken : QString();
  current_ = current;
  setEnabled(true);
  setRobot(robot);
  refresh();
}

void PosesPage::setCurrent(const Eigen::Isometry3d& base_from_camera) {
  current_ = base_from_camera;
  if (collector_) refresh();
}

void PosesPage::setRobot(const robot::Description& robot) {
  if (!collector_ || elsewhere()) return;  // poses of elsewhere stay those of their robot
  collector_->setRobot(robot);
  wrong_constants_.clear();
  refresh();
}

void PosesPage::showSnapshot(const tracking::Snapshot& snapshot) {
  if (!active()) return;
  const QString wrong = wrongConstantsOf(snapshot.transmission);
  const bool changed = wrong.isEmpty() != wrong_constants_.isEmpty();
  wrong_constants_ = wrong;
  const std::size_t poses = collector_->poses().size();
  const bool added = collector_->observe(snapshot);
  unsaved_ = unsaved_ || collector_->poses().size() > poses;
  if (added || changed) refresh();
}

void PosesPage::setEnded(bool ended) {
  ended_ = ended;
  if (collector_) refresh();
}

void PosesPage::stop() {
  if (!collector_) return;
  collector_->stop();
  refresh();
}

bool PosesPage::active() const { return collector_ && (collector_->collecting() || collector_->checking()); }

QString PosesPage::summary() const { return result_->text(); }

void PosesPage::setCollecting(bool on) {
  collector_->setCollecting(on);
  refresh();
}

void PosesPage::clear() {
  collector_->clear();
  unsaved_ = false;
  fault_.clear();
  if (elsewhere()) Q_EMIT cleared();  // begins for the present session
  refresh();
}

void PosesPage::refresh() {
  fillTable();
  refreshButtons();
  refreshTexts();
}

void PosesPage::refreshButtons() {
  const bool fitted = collector_->fit().has_value();
  const auto poses = collector_->poses().size();
  const auto used = fitted ? std::ranges::count(collector_->fit()->used, true) : 0;
  count_->setText(tr("%1 poses, %2 used").arg(poses).arg(used) +
                  (unsaved_ && !collector_->collecting() ? tr(", not saved") : QString()));
  collect_->setText(collectWords()[collector_->collecting() ? 2 : poses > 0 ? 1 : 0]);
  collect_->setEnabled((!ended_ || collector_->collecting()) && !elsewhere());
  clear_->setEnabled(poses > 0);
  save_->setEnabled(poses > 0);
  check_->setEnabled((fitted || current_) && !ended_ && !elsewhere());
  accept_->setEnabled(fitted && !elsewhere());
  reject_->setEnabled(poses > 0 && !elsewhere() && !reason_->currentText().trimmed().isEmpty());
}

void PosesPage::refreshTexts() {
  const auto& fit = collector_->fit();
  const bool any = !collector_->poses().empty();
  QString refusal = fault_;
  if (fit) {
    result_->setText(fitText(*collector_, current_));
    if (refusal.isEmpty()) refusal = QString::fromStdString(registration::warningOf(*fit));
  } else if (refusal.isEmpty()) {
    const auto words = registration::wordsOf(fit.error());
    refusal = QString::fromStdString(words.reason + ". " + words.remedy + ".");
  }
  origin_->setText(elsewhere() ? tr("These poses were taken %1, and new ones cannot join them. Save or clear "
                                    "them to collect others.")
                                     .arg(taken_)
                               : QString());
  robot_warning_->setText(wrong_constants_);
  refusal_->setText(refusal);
  result_->setVisible(fit.has_value());
  for (QLabel* notice : {origin_, robot_warning_, refusal_})
    notice->setVisible(any && !notice->text().isEmpty());
  closures_->setText(closureText(*collector_, current_));
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
    table_->setItem(row, kX + axis, numberItem(inMillimetres(pose.pair.base(axis), 1)));
  QString residual = "–", shift = "–", state = pose.excluded ? tr("excluded") : tr("no fit");
  const auto& fit = collector_->fit();
  const auto& fitted = collector_->fitted();
  const auto at = static_cast<std::size_t>(std::ranges::find(fitted, index) - fitted.begin());
  if (fit) residual = inMillimetres((fit->base_from_camera * pose.pair.camera - pose.pair.base).norm());
  if (fit && at < fitted.size()) {
    shift = fit->used[at] ? inMillimetres(fit->shifts[at]) : "–";
    state = fit->used[at] ? tr("used") : tr("outlier");
  }
  table_->setItem(row, kResidual, numberItem(residual));
  table_->setItem(row, kShift, numberItem(shift));
  table_->setItem(row, kVerdict, numberItem(state));
}

bool PosesPage::save() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Save poses"), "poses.csv", tr("Tables (*.csv)"));
  return !file.isEmpty() && saveTo(file);
}

bool PosesPage::saveTo(const QString& file) {
  fault_.clear();
  try {
    collector_->save(file.toStdString());
    unsaved_ = false;
  } catch (const base::InputError& error) {
    fault_ = QString::fromUtf8(error.what());
  }
  refresh();
  return fault_.isEmpty();
}

}  // namespace capstan::widgets
