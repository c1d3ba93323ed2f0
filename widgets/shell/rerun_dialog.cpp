#include "widgets/shell/rerun_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

namespace capstan::widgets {

RerunDialog::RerunDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Re-run with…"));
  auto* form = new QFormLayout(this);
  form->setContentsMargins(16, 16, 16, 16);
  form->setSpacing(10);
  auto* advice = new QLabel(tr(
      "Tracks the session once more, from its begin to the newest sample, and draws the UKF dashed over the "
      "plots. What is left alone stays as it is."));
  advice->setWordWrap(true);
  form->addRow(advice);
  robot_ = addFile(form, tr("Robot"), tr("Robot files (*.yaml)"));
  options_ = addFile(form, tr("Filter options"), tr("Filter options (*.yaml)"));
  filter_ = addChoice(form, tr("Filter"), {"augmented", "six_state"});
  one_camera_ = addChoice(form, tr("One camera blocked"), {"kinematics", "ray"});
  gate_ = addNumber(form, tr("Probability of the gate"), gate_on_);
  gate_->setDecimals(6);
  gate_->setRange(0.5, 0.999999);
  gate_->setValue(tracking::TrackingOptions().gate_probability);
  delay_ = addNumber(form, tr("Camera delay"), delay_on_);
  delay_->setRange(-1000.0, 1000.0);
  delay_->setDecimals(1);
  delay_->setSuffix(tr(" ms"));
  delay_->setToolTip(tr("Time stamp minus exposure of a camera sample"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Re-run"));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, [this] {
    Q_EMIT chosen(change());
    accept();
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

QLineEdit* RerunDialog::addFile(QFormLayout* form, const QString& label, const QString& filter) {
  auto* edit = new QLineEdit;
  edit->setPlaceholderText(tr("as in the session"));
  edit->setMinimumWidth(280);
  auto* browse = new QPushButton(tr("Browse…"));
  browse->setAutoDefault(false);
  auto* row = new QHBoxLayout;
  row->addWidget(edit, 1);
  row->addWidget(browse);
  form->addRow(label, row);
  connect(browse, &QPushButton::clicked, this, [this, edit, filter] {
    auto* dialog = new QFileDialog(this, tr("Choose a file"), {}, filter + tr(";;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, edit, &QLineEdit::setText);
    dialog->open();
  });
  return edit;
}

QComboBox* RerunDialog::addChoice(QFormLayout* form, const QString& label, const QStringList& names) {
  auto* box = new QComboBox;
  box->addItem(tr("as in the session"));
  box->addItems(names);
  form->addRow(label, box);
  return box;
}

QDoubleSpinBox* RerunDialog::addNumber(QFormLayout* form, const QString& label, QCheckBox*& on) {
  auto* box = new QDoubleSpinBox;
  box->setEnabled(false);
  on = new QCheckBox(tr("other than in the session:"));
  connect(on, &QCheckBox::toggled, box, &QWidget::setEnabled);
  auto* row = new QHBoxLayout;
  row->addWidget(on);
  row->addWidget(box, 1);
  form->addRow(label, row);
  return box;
}

analysis::RerunChange RerunDialog::change() const {
  analysis::RerunChange change;
  change.robot = robot_->text().trimmed().toStdString();
  change.options = options_->text().trimmed().toStdString();
  change.filter = base::fromName<tracking::FilterKind>(filter_->currentText().toStdString());
  change.one_camera = base::fromName<tracking::OneCamera>(one_camera_->currentText().toStdString());
  if (gate_on_->isChecked()) change.gate_probability = gate_->value();
  if (delay_on_->isChecked()) change.camera_delay = 1e-3 * delay_->value();
  return change;
}

}  // namespace capstan::widgets
