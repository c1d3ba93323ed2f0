#include "widgets/panels/learning/ablation_view.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <algorithm>

#include "core/base/units.h"
#include "widgets/figures/figure_text.h"
#include "widgets/panels/learning/learning_figures.h"

namespace capstan::widgets {

using namespace learning;

namespace {

constexpr int kName = 0, kColumns = 7, kMostSplits = 100, kOpeningSplits = 10;
constexpr double kPoints = 9.5;

QString cellText(double mean, double deviation) {
  return QStringLiteral("%1 ± %2")
      .arg(mean, 0, 'f', mean < 99.95 ? 1 : 0)
      .arg(deviation, 0, 'f', deviation < 99.95 ? 1 : 0);
}

double shown(double value, Eigen::Index degree) { return base::degreesOrMillimetres(value, degree >= 3); }

QString headOf(CorrectionMethod method, const CorrectionErrors& errors) {
  return QObject::tr("%1 ─ distance %2 mm, angle %3° (medians %4 mm, %5°)")
      .arg(QString::fromStdString(std::string(base::nameOf(method))))
      .arg(base::toMillimetres(errors.distance), 0, 'f', 1)
      .arg(base::toDegrees(errors.angle), 0, 'f', 1)
      .arg(base::toMillimetres(errors.median_distance), 0, 'f', 1)
      .arg(base::toDegrees(errors.median_angle), 0, 'f', 1);
}

}  // namespace

AblationView::AblationView(QWidget* parent) : LearningView(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 6, 0, 0);
  column->setSpacing(4);
  auto* row = new QHBoxLayout;
  splits_ = new QSpinBox;
  splits_->setObjectName("splits");
  splits_->setRange(1, kMostSplits);
  splits_->setValue(kOpeningSplits);
  const auto suffix = [this](int splits) { splits_->setSuffix(splits == 1 ? tr(" split") : tr(" splits")); };
  suffix(kOpeningSplits);
  connect(splits_, QOverload<int>::of(&QSpinBox::valueChanged), this, suffix);
  splits_->setToolTip(
      tr("Random splits of the trajectories, four fifths to learn from; each trains seven models"));
  run_ = new QPushButton(tr("Run the table"));
  run_->setObjectName("run_ablation");
  run_->setToolTip(tr("Error with each part of the method added in turn (F6)"));
  which_ = new QComboBox;
  which_->setObjectName("ablation_states");
  which_->addItem(tr("clean test states"));
  which_->addItem(tr("all test states"));
  which_->setToolTip(tr("The paper's clean and dirty test sets"));
  row->addWidget(splits_);
  row->addWidget(run_);
  row->addStretch();
  row->addWidget(which_);
  column->addLayout(row);
  words_ = new QLabel;
  words_->setWordWrap(true);
  column->addWidget(words_);
  column->addWidget(table_ = new QTreeWidget, 1);
  table_->setObjectName("ablation");
  table_->setColumnCount(kColumns);
  table_->setHeaderLabels({QString(), tr("x [mm]"), tr("y [mm]"), tr("z [mm]"), tr("yaw [deg]"),
                           tr("pitch [deg]"), tr("roll [deg]")});
  table_->setRootIsDecorated(false);
  table_->setItemsExpandable(false);
  table_->setIndentation(12);
  table_->setUniformRowHeights(true);
  table_->setFrameShape(QFrame::NoFrame);
  table_->setAllColumnsShowFocus(true);
  table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  table_->setAccessibleName(tr("error with each part of the method"));
  table_->header()->setStretchLastSection(false);
  table_->header()->setMinimumSectionSize(10);
  table_->header()->setFont(textFont(9.0));
  table_->header()->setSectionResizeMode(QHeaderView::Stretch);
  table_->header()->setSectionResizeMode(kName, QHeaderView::Fixed);
  table_->header()->resizeSection(kName, 60);
  for (int at = 1; at < kColumns; ++at)
    table_->headerItem()->setTextAlignment(at, Qt::AlignRight | Qt::AlignVCenter);
  connect(run_, &QPushButton::clicked, this, &AblationView::runRequested);
  connect(which_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &AblationView::fill);
}

void AblationView::setTheme(const Theme& theme) {
  theme_ = theme;
  table_->setStyleSheet(QStringLiteral("QTreeWidget::item { padding: 2px 4px; } "
                                       "QTreeWidget::item:selected { background: %1; color: %2; }")
                            .arg(theme.raised.name(), theme.text.name()));
  QPalette palette = words_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  words_->setPalette(palette);
  fill();
}

void AblationView::setReady(bool ready) {
  run_->setEnabled(ready);
  splits_->setEnabled(ready);
}

int AblationView::splits() const { return splits_->value(); }
void AblationView::setSplits(int splits) { splits_->setValue(splits); }

void AblationView::showResults(const LearningResults& results) {
  study_ = results.study;
  of_splits_ = results.splits;
  fill();
}

void AblationView::fill() {
  table_->clear();
  table_->setVisible(study_ != nullptr);
  which_->setVisible(study_ != nullptr);
  if (!study_) {
    words_->setText(
        tr("Errors with the rigid offset, cleaning, the Gaussian process and velocities as features, on "
           "held-out trajectories, beside the paper's results. Each split trains seven models, the last one "
           "with several members: this takes minutes."));
    return;
  }
  const bool clean = which_->currentIndex() == 0;
  const auto& all = clean ? study_->clean : study_->dirty;
  words_->setText(tr("Mean ± standard deviation of |error|, %1 test states of %2. Bold: our smallest.")
                      .arg(countText(all[0].states),
                           of_splits_ == 1 ? tr("one split") : tr("%1 splits").arg(of_splits_)));
  for (std::size_t m = 0; m < kCorrectionMethods; ++m) addMethod(static_cast<CorrectionMethod>(m), clean);
  table_->expandAll();
}

void AblationView::addMethod(CorrectionMethod method, bool clean) {
  const auto m = static_cast<std::size_t>(method);
  const auto& all = clean ? study_->clean : study_->dirty;
  const PaperTable& paper = clean ? paperClean() : paperDirty();
  auto* head = new QTreeWidgetItem(table_, {headOf(method, all[m])});
  head->setFlags(Qt::ItemIsEnabled);
  head->setFont(kName, textFont(kPoints, true));
  head->setFirstColumnSpanned(true);
  auto* ours = new QTreeWidgetItem(head, {tr("ours")});
  auto* theirs = m < kPaperMethods ? new QTreeWidgetItem(head, {tr("paper")}) : nullptr;
  for (int at = 1; at < kColumns; ++at) {
    const Eigen::Index k = at - 1;
    const bool least = std::all_of(all.begin(), all.end(), [&](const CorrectionErrors& errors) {
      return all[m].mean[k] <= errors.mean[k];
    });
    ours->setText(at, cellText(shown(all[m].mean[k], k), shown(all[m].deviation[k], k)));
    ours->setFont(at, numberFont(kPoints - 0.5, least));
    ours->setTextAlignment(at, Qt::AlignRight | Qt::AlignVCenter);
    if (!theirs) continue;
    const PaperCell& cell = paper[m][static_cast<std::size_t>(k)];
    theirs->setText(at, cellText(cell.mean, cell.deviation));
    theirs->setFont(at, numberFont(kPoints - 0.5));
    theirs->setTextAlignment(at, Qt::AlignRight | Qt::AlignVCenter);
    theirs->setForeground(at, theme_.muted);
  }
  ours->setFont(kName, textFont(kPoints - 0.5));
  if (!theirs) return;
  theirs->setFont(kName, textFont(kPoints - 0.5));
  theirs->setForeground(kName, theme_.muted);
}

QStringList AblationView::lines() const {
  QStringList lines;
  for (QTreeWidgetItemIterator it(table_); *it; ++it) {
    QStringList cells;
    for (int at = 0; at < kColumns; ++at)
      if (!(*it)->text(at).isEmpty()) cells << (*it)->text(at);
    lines << cells.join(QStringLiteral(" | "));
  }
  return lines;
}

}  // namespace capstan::widgets
