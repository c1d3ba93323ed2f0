#include "widgets/shell/live_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

#include "core/base/error.h"
#include "core/live/cameras/video_devices.h"
#include "core/live/streams/address.h"
#include "widgets/shell/address_box.h"
#include "widgets/shell/live_fields.h"
#include "widgets/shell/live_preview_view.h"
#include "widgets/shell/live_topics.h"

namespace capstan::widgets {
namespace {

constexpr const char* kAddress = "tcp://127.0.0.1:5555";
constexpr double kPerSecond = 1e3;  // ms
constexpr int kRest = 500;          // ms; a form that stays so long is not being filled in

/// Without the fields that change nothing in a preview.
live::LiveSetup previewedPartOf(live::LiveSetup setup) {
  setup.title.clear(), setup.commands.reset();
  if (!setup.cameras) return setup;
  setup.cameras->calibration.clear(), setup.cameras->registration.clear(), setup.cameras->marker.clear();
  setup.cameras->latency = 0.0;
  return setup;
}

}  // namespace

LiveDialog::LiveDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("live");
  setWindowTitle(tr("Connect to a live robot"));
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(12, 8, 12, 8);
  grid->setSpacing(8);
  auto* general = new QGroupBox(tr("Robot"));
  auto* form = new QFormLayout(general);
  title_ = new QLineEdit;
  addField<live::LiveSetup>(form, tr("Title"), title_, "title");
  robot_ = addPath(form, tr("Robot file"), meaningOf<live::LiveSetup>("robot"), "robot");
  robot_->setPlaceholderText(tr("RAVEN-II, left arm"));
  grid->addWidget(general, 0, 0);
  grid->addWidget(makeMotors(), 1, 0);
  grid->addWidget(makeCameras(), 2, 0);
  topics_ = new LiveTopics(from_, {left_, right_}, this);
  static_cast<QFormLayout*>(from_->parentWidget()->layout())->insertRow(1, QString(), topics_->label());
  auto* side = new QGroupBox(tr("Preview"));
  preview_ = new LivePreviewView;
  auto* layout = new QVBoxLayout(side);
  layout->addWidget(preview_);
  grid->addWidget(side, 0, 1, 3, 1);
  message_ = new QLabel;
  message_->setObjectName("message");
  message_->setWordWrap(true);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  message_->setMinimumHeight(2 * fontMetrics().lineSpacing());  // most faults fit: nothing moves
  grid->addWidget(message_, 3, 0, 1, 2);
  grid->addWidget(makeButtons(), 4, 0, 1, 2);
  grid->setColumnStretch(0, 1);
  watch_.setInterval(kRest);
  connect(&watch_, &QTimer::timeout, this, &LiveDialog::followForm);
  live::LiveSetup initial;
  initial.title = tr("my robot").toStdString();
  setSetup(initial);
}

QLineEdit* LiveDialog::addPath(QFormLayout* form, const QString& label, const QString& tip,
                               const QString& name) {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  auto* edit = new QLineEdit;
  edit->setToolTip(tip);
  edit->setObjectName(name);
  auto* browse = new QPushButton(tr("Browse…"));
  browse->setAutoDefault(false);
  browse->setAccessibleName(tr("Browse for %1").arg(label));
  line->addWidget(edit, 1);
  line->addWidget(browse);
  form->addRow(label, row);
  connect(browse, &QPushButton::clicked, this, [this, edit, label] {
    auto* dialog = new QFileDialog(this, label, edit->text());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, edit, [edit](const QString& path) { edit->setText(path); });
    dialog->open();
  });
  return edit;
}

QGroupBox* LiveDialog::makeMotors() {
  auto* group = new QGroupBox(tr("Motors"));
  auto* form = new QFormLayout(group);
  form->setVerticalSpacing(4);
  from_ = editableBox();
  from_->addItem(kAddress);
  addField<live::RowsSetup>(form, tr("From"), from_, "from");
  read_as_ = new QLineEdit;
  read_as_->setPlaceholderText(tr("SI"));
  addField<live::RowsSetup>(form, tr("Units"), read_as_, "read_as");
  for (std::size_t joint = 0; joint < motors_.size(); ++joint) {
    Motor& motor = motors_[joint];
    motor = {new QSpinBox, new QCheckBox(tr("counts the other way"))};
    motor.from->setObjectName(QString("motor_%1").arg(joint + 1));
    motor.from->setRange(1, 3);
    motor.from->setPrefix(tr("motor "));
    motor.from->setToolTip(meaningOf<live::RowsSetup>("motors"));
    motor.reversed->setObjectName(QString("reversed_%1").arg(joint + 1));
    motor.reversed->setToolTip(meaningOf<live::RowsSetup>("signs"));
    auto* row = new QWidget;
    auto* line = new QHBoxLayout(row);
    line->setContentsMargins(0, 0, 0, 0);
    line->addWidget(motor.from);
    line->addWidget(motor.reversed, 1);
    form->addRow(tr("Joint %1").arg(joint + 1), row);
  }
  reference_ = new QCheckBox(tr("columns q are joint encoders"));
  addField<live::RowsSetup>(form, tr("Reference"), reference_, "reference");
  return group;
}

QGroupBox* LiveDialog::makeCameras() {
  using Cameras = live::CamerasSetup;
  cameras_ = new QGroupBox(tr("Cameras"));
  cameras_->setObjectName("cameras");
  cameras_->setCheckable(true);
  auto* form = new QFormLayout(cameras_);
  form->setVerticalSpacing(4);
  layout_ = new QComboBox;
  layout_->addItems({tr("two streams"), tr("one stream, left | right"), tr("one stream, left above right")});
  addField<Cameras>(form, tr("Layout"), layout_, "layout");
  connect(layout_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &LiveDialog::fitLayout);
  left_ = editableBox();
  addField<Cameras>(form, tr("Left"), left_, "left");
  right_ = editableBox();
  addField<Cameras>(form, tr("Right"), right_, "right");
  size_ = editableBox();
  size_->setMinimumContentsLength(12);  // half a row
  size_->lineEdit()->setPlaceholderText(tr("the device's own"));
  rate_ = numberBox(tr(" frames/s"), 1000.0, 0);
  rate_->setSpecialValueText(tr("the device's own"));
  addFields<Cameras>(form, tr("Size, rate"), size_, "size", rate_, "rate");
  size_->setToolTip(tr("Width × height of each stream's images [px]; empty: as the device gives them"));
  calibration_ = addPath(form, tr("Calibration"), meaningOf<Cameras>("calibration"), "calibration");
  registration_ = addPath(form, tr("Registration"), meaningOf<Cameras>("registration"), "registration");
  registration_->setPlaceholderText(tr("none: register first"));
  marker_ = addPath(form, tr("Marker"), meaningOf<Cameras>("marker"), "marker");
  marker_->setPlaceholderText(tr("green ball"));
  latency_ = numberBox(tr(" ms"), 2000.0, 1);
  latency_->setMinimum(-2000.0);  // a video file may begin after the first row
  pairing_ = numberBox(tr(" ms"), 1000.0, 1);
  addFields<Cameras>(form, tr("Latency, pairing"), latency_, "latency", pairing_, "pairing");
  return cameras_;
}

void LiveDialog::showLive(const QString& live) {
  if (!live::isAddress(live.toStdString())) return openFile(live);
  live::LiveSetup setup;
  setup.title = title_->text().toStdString();
  setup.motors.from = live.toStdString();
  setSetup(setup);
}

QWidget* LiveDialog::makeButtons() {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](const char* name, const QString& text, const QString& tip) {
    auto* button = new QPushButton(text);
    button->setObjectName(name);
    button->setToolTip(tip);
    button->setAutoDefault(false);
    line->addWidget(button);
    return button;
  };
  connect(add("open", tr("Open…"), tr("Read a live set-up file")), &QPushButton::clicked, this,
          &LiveDialog::askOpen);
  connect(add("save", tr("Save as…"), tr("Write a live set-up file")), &QPushButton::clicked, this,
          [this] { askSave(false); });
  line->addStretch(1);
  preview_button_ = add("preview", tr("Preview"), tr("Show what comes, without a session"));
  preview_button_->setCheckable(true);
  connect(preview_button_, &QPushButton::toggled, this, &LiveDialog::togglePreview);
  connect(add("cancel", tr("Cancel"), {}), &QPushButton::clicked, this, &QDialog::reject);
  auto* connect_button = add("connect", tr("Connect"), tr("Begin a session with this robot"));
  connect_button->setDefault(true);
  connect(connect_button, &QPushButton::clicked, this, &LiveDialog::connectRobot);
  return row;
}

void LiveDialog::fillDevices() {
  const std::vector<live::VideoDevice> devices = live::listVideoDevices();
  for (auto* box : {left_, right_}) {
    const std::string value = valueOf(*box);
    box->clear();
    for (const live::VideoDevice& device : devices)
      if (device.fault.empty())
        box->addItem(tr("%1 — %2, %3").arg(device.path.c_str(), device.name.c_str(), device.at.c_str()),
                     QString::fromStdString(device.path));
    setValue(*box, value);
  }
  const QString size = size_->currentText();
  size_->clear();
  for (const live::VideoDevice& device : devices)
    for (const live::VideoFormat& format : device.formats) {
      const QString text = tr("%1 × %2").arg(format.width).arg(format.height);
      if (size_->findText(text) < 0) size_->addItem(text);
    }
  size_->setEditText(size);
  topics_->refill();
}

void LiveDialog::fitLayout() {
  right_->setEnabled(layout_->currentIndex() == static_cast<int>(live::CameraLayout::kTwo));
}

void LiveDialog::setSetup(const live::LiveSetup& setup) {
  title_->setText(QString::fromStdString(setup.title));
  robot_->setText(QString::fromStdString(setup.robot));
  other_motors_ = setup.motors;
  commands_ = setup.commands;
  setValue(*from_, setup.motors.from);
  read_as_->setText(QString::fromStdString(setup.motors.read_as));
  for (std::size_t joint = 0; joint < motors_.size(); ++joint) {
    motors_[joint].from->setValue(setup.motors.motors[joint]);
    motors_[joint].reversed->setChecked(setup.motors.signs[joint] < 0.0);
  }
  reference_->setChecked(setup.motors.reference);
  cameras_->setChecked(setup.cameras.has_value());
  other_ = setup.cameras.value_or(live::CamerasSetup{});
  layout_->setCurrentIndex(static_cast<int>(other_.layout));
  setValue(*left_, other_.left);
  setValue(*right_, other_.right);
  size_->setEditText(other_.width > 0 ? tr("%1 × %2").arg(other_.width).arg(other_.height) : QString());
  rate_->setValue(other_.rate);
  calibration_->setText(QString::fromStdString(other_.calibration));
  registration_->setText(QString::fromStdString(other_.registration));
  marker_->setText(QString::fromStdString(other_.marker));
  latency_->setValue(other_.latency * kPerSecond);
  pairing_->setValue(other_.pairing * kPerSecond);
  fitLayout();
}

live::LiveSetup LiveDialog::setup() const {
  live::LiveSetup setup;
  setup.title = title_->text().toStdString();
  setup.robot = robot_->text().trimmed().toStdString();
  setup.motors = other_motors_;
  setup.commands = commands_;
  setup.motors.from = valueOf(*from_);
  setup.motors.read_as = read_as_->text().trimmed().toStdString();
  for (std::size_t joint = 0; joint < motors_.size(); ++joint) {
    setup.motors.motors[joint] = motors_[joint].from->value();
    setup.motors.signs[joint] = motors_[joint].reversed->isChecked() ? -1.0 : 1.0;
  }
  setup.motors.reference = reference_->isChecked();
  if (!cameras_->isChecked()) return setup;
  live::CamerasSetup cameras = other_;
  cameras.layout = static_cast<live::CameraLayout>(layout_->currentIndex());
  cameras.left = valueOf(*left_);
  cameras.right = cameras.layout == live::CameraLayout::kTwo ? valueOf(*right_) : std::string();
  const QStringList size = size_->currentText().split(QRegExp("\\D+"), Qt::SkipEmptyParts);
  cameras.width = size.size() == 2 ? size[0].toInt() : 0;
  cameras.height = size.size() == 2 ? size[1].toInt() : 0;
  cameras.rate = rate_->value();
  cameras.calibration = calibration_->text().trimmed().toStdString();
  cameras.registration = registration_->text().trimmed().toStdString();
  cameras.marker = marker_->text().trimmed().toStdString();
  cameras.latency = latency_->value() / kPerSecond;
  cameras.pairing = pairing_->value() / kPerSecond;
  setup.cameras = cameras;
  return setup;
}

bool LiveDialog::showingFaults(const std::function<void()>& work) {
  try {
    work();
    message_->clear();
    return true;
  } catch (const base::InputError& error) {
    message_->setText(QString::fromStdString(error.what()));
    return false;
  }
}

void LiveDialog::openFile(const QString& file) {
  if (showingFaults([&] { setSetup(live::readLiveSetup(file.toStdString())); })) file_ = file;
}

bool LiveDialog::saveFile(const QString& file) {
  const bool saved = showingFaults([&] { live::writeLiveSetup(setup(), file.toStdString()); });
  if (saved) file_ = file;
  return saved;
}

void LiveDialog::askOpen() {
  auto* dialog =
      new QFileDialog(this, tr("Open a live set-up"), file_, tr("Live set-ups (*.yaml);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, &LiveDialog::openFile);
  dialog->open();
}

void LiveDialog::askSave(bool then_connect) {
  if (!showingFaults([&] { live::checkLiveSetup(setup()); })) return;
  auto* dialog = new QFileDialog(this, tr("Save the live set-up"), file_.isEmpty() ? "robot.yaml" : file_,
                                 tr("Live set-ups (*.yaml)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix("yaml");
  connect(dialog, &QFileDialog::fileSelected, this, [this, then_connect](const QString& file) {
    if (saveFile(file) && then_connect) connectRobot();
  });
  dialog->open();
}

void LiveDialog::togglePreview(bool on) {
  message_->clear();
  if (on) {
    watch_.start();
    return beginPreview();
  }
  watch_.stop();
  preview_->stop();
}

void LiveDialog::beginPreview() {
  message_->clear();
  const live::LiveSetup now = besideFile();
  previewed_ = seen_ = previewedPartOf(now);
  preview_->stop();
  if (previewed_.motors.from == "-")
    return message_->setText(tr("Standard input cannot be previewed: its rows are read once."));
  preview_->start(now);
}

void LiveDialog::followForm() {
  const live::LiveSetup now = previewedPartOf(besideFile());
  if (now == seen_ && now != previewed_) beginPreview();
  seen_ = now;
}

live::LiveSetup LiveDialog::besideFile() const {
  const live::LiveSetup now = setup();
  return file_.isEmpty() ? now : live::resolvedFrom(now, QFileInfo(file_).path().toStdString());
}

bool LiveDialog::isAddressOnly() const {
  live::LiveSetup plain = setup(), address;
  address.motors.from = plain.motors.from;
  address.title = plain.title;
  return live::isAddress(plain.motors.from) && plain == address;
}

void LiveDialog::connectRobot() {
  preview_button_->setChecked(false);
  if (isAddressOnly()) {
    Q_EMIT chosen(QString::fromStdString(valueOf(*from_)));
    return accept();
  }
  bool saved = false;
  if (!file_.isEmpty()) try {
      saved = live::readLiveSetup(file_.toStdString()) == besideFile();
    } catch (const base::InputError&) {  // it is written again
    }
  if (!saved) return askSave(true);
  Q_EMIT chosen(file_);
  accept();
}

void LiveDialog::showEvent(QShowEvent* event) {
  fillDevices();
  topics_->setOn(true);
  QDialog::showEvent(event);
}

void LiveDialog::hideEvent(QHideEvent* event) {
  preview_button_->setChecked(false);
  topics_->setOn(false);
  QDialog::hideEvent(event);
}

}  // namespace capstan::widgets
