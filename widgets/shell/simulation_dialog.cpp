#include "widgets/shell/simulation_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QPushButton>
#include <QSpinBox>

namespace capstan::widgets {

namespace {

constexpr const char* kAskFile = "?";

/// Selects the entry with the data `value`; a file without an entry gets a new one.
void select(QComboBox* box, const QString& value) {
  int index = box->findData(value);
  if (index < 0) {
    index = box->count() - 1;
    box->insertItem(index, QFileInfo(value).fileName(), value);
    box->setItemData(index, value, Qt::ToolTipRole);
  }
  box->setCurrentIndex(index);
}

}  // namespace

SimulationDialog::SimulationDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("New simulated session"));
  auto* form = new QFormLayout(this);
  form->setContentsMargins(16, 16, 16, 16);
  form->setSpacing(10);
  trajectory_ = addChoice(form, tr("Movement"),
                          {{tr("FLS block transfer"), "fls"},
                           {tr("sinusoid"), "sinusoid"},
                           {tr("at rest"), "hold"},
                           {tr("at the hard stop"), "hard-stop"}},
                          tr("Joint trajectories (*.csv)"));
  duration_ = new QDoubleSpinBox;
  duration_->setRange(1.0, 86400.0);
  duration_->setDecimals(0);
  duration_->setSuffix(tr(" s"));
  form->addRow(tr("Duration"), duration_);
  seed_ = new QSpinBox;
  seed_->setRange(0, std::numeric_limits<int>::max());
  seed_->setToolTip(tr("Surgeon, noise and texture: the same seed gives the same session"));
  form->addRow(tr("Seed"), seed_);
  truth_ = addChoice(form, tr("Real robot"),
                     {{tr("differs from its file (default truth)"), "default"},
                      {tr("just as its file says (matched)"), "matched"}},
                     tr("Truth files (*.yaml)"));
  robot_ = addChoice(form, tr("Robot file"), {{tr("RAVEN-II, left arm"), ""}}, tr("Robot files (*.yaml)"));
  distractors_ = new QCheckBox(tr("objects of nearly the marker's colour"));
  uneven_light_ = new QCheckBox(tr("one side of the scene in the dark"));
  registered_ = new QCheckBox(tr("cameras registered already"));
  form->addRow(tr("Scene"), distractors_);
  form->addRow(QString(), uneven_light_);
  form->addRow(tr("Cameras"), registered_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setText(tr("Start"));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, [this] {
    Q_EMIT chosen(request());
    accept();
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  setRequest({});
}

QComboBox* SimulationDialog::addChoice(QFormLayout* form, const QString& label,
                                       const QList<QPair<QString, QString>>& names, const QString& filter) {
  auto* box = new QComboBox;
  box->setMinimumWidth(280);
  for (const auto& [text, name] : names) box->addItem(text, name);
  box->addItem(tr("file…"), kAskFile);
  connect(box, QOverload<int>::of(&QComboBox::activated), this, [this, box, filter] {
    if (box->currentData() == kAskFile) askFile(box, filter);
  });
  form->addRow(label, box);
  return box;
}

void SimulationDialog::askFile(QComboBox* box, const QString& filter) {
  box->setCurrentIndex(0);
  auto* dialog = new QFileDialog(this, tr("Choose a file"), {}, filter + tr(";;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, box, [box](const QString& file) { select(box, file); });
  dialog->open();
}

void SimulationDialog::setRequest(const simulation::SimulationRequest& request) {
  select(trajectory_, QString::fromStdString(request.trajectory));
  select(truth_, QString::fromStdString(request.truth));
  select(robot_, QString::fromStdString(request.robot.string()));
  duration_->setValue(request.duration);
  seed_->setValue(static_cast<int>(request.seed));
  registered_->setChecked(request.registered);
  distractors_->setChecked(request.distractors);
  uneven_light_->setChecked(request.uneven_light);
}

simulation::SimulationRequest SimulationDialog::request() const {
  simulation::SimulationRequest request;
  request.trajectory = trajectory_->currentData().toString().toStdString();
  request.duration = duration_->value();
  request.truth = truth_->currentData().toString().toStdString();
  request.seed = static_cast<std::uint64_t>(seed_->value());
  request.robot = robot_->currentData().toString().toStdString();
  request.registered = registered_->isChecked();
  request.distractors = distractors_->isChecked();
  request.uneven_light = uneven_light_->isChecked();
  return request;
}

}  // namespace capstan::widgets
