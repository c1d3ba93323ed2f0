#include "widgets/panels/experiments/experiment_picker.h"

#include <QAbstractItemView>
#include <QBoxLayout>
#include <QComboBox>

#include "core/recording/recording_kinds.h"

namespace capstan::widgets {

using experiments::CorrectionExperiment;

namespace {

constexpr int kLeastLetters = 12;  // shown of an entry in a window of 1280 px

/// The entries stay whole in the list that opens.
void shrinkWithItsRow(QComboBox& box) {
  box.view()->setMinimumWidth(box.sizeHint().width());
  box.setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box.setMinimumContentsLength(kLeastLetters);
  box.setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

}  // namespace

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
  for (QComboBox* box : {experiment_, towards_}) {
    shrinkWithItsRow(*box);
    connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
      refresh();
      Q_EMIT changed();
    });
  }
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
