#include "widgets/panels/experiments/experiment_picker.h"
#include "core/recording/recording_kinds.h"

#include <QBoxLayout>
#include <QComboBox>

namespace capstan::widgets {

using experiments::CorrectionExperiment;

ExperimentPicker::ExperimentPicker(QWidget* parent)
    : FilePicker({"experiment_tables", tr("tables"),
                  tr("tables of tip poses to learn from and to measure errors on"), tr("Tables of tip poses"),
                  tr("Tables (%1);;All files (*)").arg(QString::fromStdString(recording::tablePatterns()))},
                 parent),
      experiment_(new QComboBox),
      towards_(new QComboBox) {
  experiment_->setObjectName("experiment");
  experiment_->addItems(
      {tr("E  Errors of corrected poses (table I)"), tr("F  Number of training states (figure 5)"),
       tr("G  Arrival at fragments, simulated (table II)"), tr("H  Debridement, simulated (section V-D)")});
  experiment_->setToolTip(tr("Experiment of the GPR paper; its published numbers stand beside the results"));
  towards_->setObjectName("experiment_towards");
  towards_->addItems({tr("towards the command"), tr("towards the kinematics")});
  towards_->setToolTip(tr("Stream that observed poses are compared with"));
  row()->insertWidget(0, experiment_);
  row()->addWidget(towards_);
  for (QComboBox* box : {experiment_, towards_})
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
      refresh();
      Q_EMIT changed();
    });
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

void ExperimentPicker::refresh() {
  FilePicker::refresh();
  const bool poses = needsPoses(experiment());
  setFilesVisible(poses);
  towards_->setVisible(poses);
}

}  // namespace capstan::widgets
