#include "widgets/panels/learning/table_picker.h"
#include "core/recording/recording_kinds.h"

#include <QBoxLayout>
#include <QComboBox>

namespace capstan::widgets {

using learning::StreamKind;

TablePicker::TablePicker(QWidget* parent)
    : FilePicker({"tables", tr("tables"), tr("tables of tip poses"), tr("Tables of tip poses of one robot"),
                  tr("Tables (%1);;All files (*)").arg(QString::fromStdString(recording::tablePatterns()))},
                 parent),
      towards_(new QComboBox) {
  towards_->setObjectName("towards");
  for (const StreamKind stream : {StreamKind::kCommand, StreamKind::kRobot})
    towards_->addItem(tr("towards the %1").arg(nameOf(stream)), static_cast<int>(stream));
  towards_->setToolTip(
      tr("Stream to correct towards: the command, or the pose from the robot's forward kinematics"));
  row()->addWidget(towards_);
  connect(towards_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    const auto towards = static_cast<StreamKind>(towards_->currentData().toInt());
    if (towards == choice_.towards) return;
    choice_.towards = towards;
    Q_EMIT changed();
  });
  refresh();
}

void TablePicker::setChoice(const LearningChoice& choice) {
  choice_ = choice;
  refresh();
}

void TablePicker::refresh() {
  FilePicker::refresh();
  towards_->setCurrentIndex(towards_->findData(static_cast<int>(choice_.towards)));
}

}  // namespace capstan::widgets
