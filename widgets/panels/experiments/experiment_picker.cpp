#include "widgets/panels/experiments/experiment_picker.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace capstan::widgets {

using experiments::CorrectionExperiment;

ExperimentPicker::ExperimentPicker(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  experiment_ = new QComboBox;
  experiment_->setObjectName("experiment");
  experiment_->addItems(
      {tr("E  Errors of corrected poses (table I)"), tr("F  Number of training states (figure 5)"),
       tr("G  Arrival at fragments, simulated (table II)"), tr("H  Debridement, simulated (section V-D)")});
  experiment_->setToolTip(tr("Experiment of the GPR paper; its published numbers stand beside the results"));
  ask_ = new QToolButton;
  ask_->setObjectName("experiment_tables");
  ask_->setText(tr("Tables…"));
  ask_->setToolTip(tr("Tables of tip poses to learn from and to measure errors on"));
  towards_ = new QComboBox;
  towards_->setObjectName("experiment_towards");
  towards_->addItems({tr("towards the command"), tr("towards the kinematics")});
  towards_->setToolTip(tr("Stream that observed poses are compared with"));
  names_ = new QLabel;
  names_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  row->addWidget(experiment_);
  row->addWidget(ask_);
  row->addWidget(towards_);
  row->addWidget(names_, 1);
  for (QComboBox* box : {experiment_, towards_})
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
      refresh();
      Q_EMIT changed();
    });
  connect(ask_, &QToolButton::clicked, this, &ExperimentPicker::askTables);
  refresh();
}

CorrectionExperiment ExperimentPicker::experiment() const {
  return static_cast<CorrectionExperiment>(experiment_->currentIndex());
}

learning::StreamKind ExperimentPicker::towards() const {
  return towards_->currentIndex() == 0 ? learning::StreamKind::kCommand : learning::StreamKind::kRobot;
}

bool ExperimentPicker::complete() const { return !needsPoses(experiment()) || !tables_.isEmpty(); }

void ExperimentPicker::choose(CorrectionExperiment experiment) {
  experiment_->setCurrentIndex(static_cast<int>(experiment));
}

void ExperimentPicker::setTowards(learning::StreamKind towards) {
  towards_->setCurrentIndex(towards == learning::StreamKind::kCommand ? 0 : 1);
}

void ExperimentPicker::setTables(const QStringList& tables) {
  tables_ = tables;
  refresh();
  Q_EMIT changed();
}

void ExperimentPicker::askTables() {
  auto* dialog = new QFileDialog(this, tr("Tables of tip poses"), {}, tr("Tables (*.csv);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  connect(dialog, &QFileDialog::filesSelected, this, &ExperimentPicker::setTables);
  dialog->show();
}

void ExperimentPicker::refresh() {
  const bool poses = needsPoses(experiment());
  ask_->setVisible(poses);
  towards_->setVisible(poses);
  names_->setVisible(poses);
  QStringList names;
  for (const QString& table : tables_) names << QFileInfo(table).fileName();
  names_->setText(names.isEmpty() ? tr("no table chosen") : names.join(QStringLiteral(", ")));
  names_->setToolTip(tables_.join(QLatin1Char('\n')));
}

}  // namespace capstan::widgets
