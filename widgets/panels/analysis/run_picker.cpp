#include "widgets/panels/analysis/run_picker.h"
#include "core/recording/recording_kinds.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QSignalBlocker>
#include <QToolButton>

namespace capstan::widgets {

using Kind = RunChoice::Kind;

namespace {

/// Label that fills the available width, with its text shortened in the middle.
class ElidedLabel : public QLabel {
 public:
  ElidedLabel() { setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); }
  void setWhole(const QString& text) {
    whole_ = text;
    elide();
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QLabel::resizeEvent(event);
    elide();
  }

 private:
  void elide() { setText(fontMetrics().elidedText(whole_, Qt::ElideMiddle, width())); }
  QString whole_;
};

}  // namespace

void RunChoice::save(QSettings& settings, const QString& key) const {
  settings.setValue(key + "/kind", static_cast<int>(kind));
  settings.setValue(key + "/path", path);
  settings.setValue(key + "/trial", trial);
  settings.setValue(key + "/robot", robot);
}

RunChoice RunChoice::restore(const QSettings& settings, const QString& key, Kind otherwise) {
  const int kind = settings.value(key + "/kind", static_cast<int>(otherwise)).toInt();
  RunChoice choice{
      kind >= 0 && kind <= static_cast<int>(Kind::kResults) ? static_cast<Kind>(kind) : otherwise,
      settings.value(key + "/path").toString(), settings.value(key + "/trial").toString(),
      settings.value(key + "/robot").toString()};
  const bool needs_path = choice.kind == Kind::kRecording || choice.kind == Kind::kResults;
  if (needs_path && choice.path.isEmpty()) choice.kind = otherwise;
  return choice;
}

RunPicker::RunPicker(const QString& letter, bool may_be_none, QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  letter_ = new QLabel(letter);
  letter_->setFont(textFont(11.0, true));
  kind_ = new QComboBox;
  kind_->setObjectName("kind");
  kind_->setAccessibleName(tr("source of run %1").arg(letter));
  if (may_be_none) kind_->addItem(tr("no second run"), static_cast<int>(Kind::kNone));
  kind_->addItem(tr("this session, so far"), static_cast<int>(Kind::kSession));
  kind_->addItem(tr("recording…"), static_cast<int>(Kind::kRecording));
  kind_->addItem(tr("experiment…"), static_cast<int>(Kind::kResults));
  what_ = new ElidedLabel;
  browse_ = new QToolButton;
  browse_->setText(tr("Choose…"));
  browse_->setObjectName("browse");
  trial_ = new QComboBox;
  trial_->setObjectName("trial");
  trial_->setAccessibleName(tr("trial of run %1").arg(letter));
  robot_ = new QToolButton;
  robot_->setObjectName("robot");
  robot_->setToolTip(tr("Robot of the estimator: the recording's own, or from another file"));
  robot_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(robot_);
  menu->addAction(tr("the recording's own"), this, [this] {
    RunChoice choice = choice_;
    choice.robot.clear();
    choose(choice);
  });
  menu->addAction(tr("robot file…"), this, &RunPicker::askRobot);
  robot_->setMenu(menu);
  row->addWidget(letter_);
  row->addWidget(kind_);
  row->addWidget(what_, 1);
  row->addWidget(browse_);
  row->addWidget(trial_);
  row->addWidget(robot_);
  connect(kind_, QOverload<int>::of(&QComboBox::activated), this, &RunPicker::onKind);
  connect(browse_, &QToolButton::clicked, this, [this] { ask(choice_.kind); });
  connect(trial_, QOverload<int>::of(&QComboBox::activated), this, [this](int index) {
    RunChoice choice = choice_;
    choice.trial = trial_->itemText(index);
    choose(choice);
  });
  refresh();
}

void RunPicker::setTheme(const Theme& theme) {
  QPalette palette = what_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  what_->setPalette(palette);
}

void RunPicker::choose(const RunChoice& choice) {
  const bool differs = !(choice == choice_);
  setChoice(choice);
  if (differs) Q_EMIT changed();
}

void RunPicker::setChoice(const RunChoice& choice) {
  if (choice.path != choice_.path || choice.kind != Kind::kResults) trial_->clear();
  choice_ = choice;
  refresh();
}

void RunPicker::setTrials(const QStringList& trials, const QString& current) {
  const QSignalBlocker quiet(trial_);
  trial_->clear();
  trial_->addItems(trials);
  trial_->setCurrentText(current);
  refresh();
}

/// The choice does not change to a kind that needs a file before a file is chosen.
void RunPicker::onKind(int index) {
  const auto kind = static_cast<Kind>(kind_->itemData(index).toInt());
  if (kind == Kind::kNone || kind == Kind::kSession) return choose({.kind = kind});
  refresh();
  ask(kind);
}

void RunPicker::ask(Kind kind) {
  const bool folder = kind == Kind::kResults;
  auto* dialog = new QFileDialog(
      this, folder ? tr("Folder of an experiment's results") : tr("Recording"),
      choice_.path.isEmpty() ? QString() : QFileInfo(choice_.path).path(),
      folder
          ? QString()
          : tr("Recordings (%1);;All files (*)").arg(QString::fromStdString(recording::recordingPatterns())));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(folder ? QFileDialog::Directory : QFileDialog::ExistingFile);
  if (folder) dialog->setOption(QFileDialog::ShowDirsOnly);
  connect(dialog, &QFileDialog::fileSelected, this, [this, kind](const QString& path) {
    RunChoice choice{.kind = kind, .path = QFileInfo(path).absoluteFilePath()};
    if (kind == Kind::kRecording) choice.robot = choice_.robot;
    choose(choice);
  });
  dialog->open();
}

void RunPicker::askRobot() {
  auto* dialog = new QFileDialog(this, tr("Robot of the estimator"), QFileInfo(choice_.path).path(),
                                 tr("Robot files (*.yaml);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
    RunChoice choice = choice_;
    choice.robot = QFileInfo(path).absoluteFilePath();
    choose(choice);
  });
  dialog->open();
}

QString RunPicker::words() const {
  const bool file = choice_.kind == Kind::kRecording || choice_.kind == Kind::kResults;
  return file ? QFileInfo(choice_.path).fileName() : QString();
}

void RunPicker::refresh() {
  const QSignalBlocker quiet(kind_);
  kind_->setCurrentIndex(kind_->findData(static_cast<int>(choice_.kind)));
  const bool file = choice_.kind == Kind::kRecording || choice_.kind == Kind::kResults;
  static_cast<ElidedLabel*>(what_)->setWhole(words());
  what_->setToolTip(QDir::toNativeSeparators(choice_.path));
  browse_->setVisible(file);
  trial_->setVisible(choice_.kind == Kind::kResults && trial_->count() > 0);
  robot_->setVisible(choice_.kind == Kind::kRecording);
  const QString robot =
      choice_.robot.isEmpty() ? tr("own robot") : QFileInfo(choice_.robot).completeBaseName();
  robot_->setText(robot + QStringLiteral(" ▾"));
}

}  // namespace capstan::widgets
