#include "widgets/panels/diagnosis/effort_box.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>

namespace capstan::widgets {

namespace {

QString textOf(double effort) { return QStringLiteral("×%1").arg(effort, 0, 'g', 6); }

}  // namespace

EffortBox::EffortBox(QWidget* parent) : QWidget(parent), box_(new QComboBox) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  auto* name = new QLabel(tr("Effort"));
  name->setBuddy(box_);
  row->addWidget(name);
  row->addWidget(box_);
  box_->setObjectName("effort");
  box_->setAccessibleName(tr("effort of the search for causes"));
  box_->setToolTip(
      tr("Multiplies the limit of the search for causes. ×1 is enough for most arms of three joints; more "
         "where the "
         "report says that the search ended at its limit. Tables of tip poses do not use it."));
  for (const double effort : {0.25, 1.0, 2.0, 4.0, 16.0}) box_->addItem(textOf(effort), effort);
  setEffort(1.0);
  connect(box_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &EffortBox::changed);
}

double EffortBox::effort() const { return box_->currentData().toDouble(); }

void EffortBox::setEffort(double effort) {
  const QSignalBlocker quiet(box_);
  int at = box_->findData(effort);
  if (at < 0) {
    box_->addItem(textOf(effort), effort);
    at = box_->count() - 1;
  }
  box_->setCurrentIndex(at);
}

}  // namespace capstan::widgets
