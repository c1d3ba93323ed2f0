#include "widgets/panels/diagnosis/recording_picker.h"

#include <QBoxLayout>
#include <QDir>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QShortcut>
#include <QToolButton>

namespace capstan::widgets {

namespace {

QToolButton* menuButton(const QString& name, const QString& tip, QMenu* menu) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu);
  return button;
}

QString folderOf(const QStringList& files) {
  return files.isEmpty() ? QString() : QFileInfo(files.back()).path();
}

}  // namespace

RecordingPicker::RecordingPicker(QWidget* parent) : QWidget(parent), menu_(new QMenu(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  recordings_ =
      menuButton("recordings", tr("Add or remove recordings (Ctrl+Shift+O adds); or drop files here"), menu_);
  recordings_->setText(tr("Recordings ▾"));
  what_ = new QLabel;
  what_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  what_->setAccessibleName(tr("recordings chosen"));
  offer_ = new QToolButton;
  offer_->setObjectName("offered");
  auto* robots = new QMenu(this);
  robots->addAction(tr("the recordings' own, or the left RAVEN-II"), this, [this] {
    DiagnosisChoice choice = choice_;
    choice.robot.clear();
    choose(choice);
  });
  robots->addAction(tr("robot file…"), this, &RecordingPicker::askRobot);
  robot_ = menuButton("nominal_robot", tr("The nominal robot"), robots);
  row->addWidget(recordings_);
  row->addWidget(what_, 1);
  row->addWidget(offer_);
  row->addWidget(robot_);
  setAcceptDrops(true);
  connect(menu_, &QMenu::aboutToShow, this, &RecordingPicker::fillMenu);
  connect(offer_, &QToolButton::clicked, this, &RecordingPicker::takeOffered);
  connect(new QShortcut(QKeySequence(QStringLiteral("Ctrl+Shift+O")), this), &QShortcut::activated, this,
          &RecordingPicker::askRecordings);
  refresh();
}

void RecordingPicker::setTheme(const Theme& theme) {
  QPalette palette = what_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  what_->setPalette(palette);
}

void RecordingPicker::choose(const DiagnosisChoice& choice) {
  const bool differs = !(choice == choice_);
  setChoice(choice);
  if (differs) Q_EMIT changed();
}

void RecordingPicker::setChoice(const DiagnosisChoice& choice) {
  choice_ = choice;
  refresh();
}

void RecordingPicker::offer(const QString& path, const QString& words) {
  offered_ = path;
  offer_->setText(words);
  refresh();
}

void RecordingPicker::takeOffered() {
  if (offered_.isEmpty()) return;
  DiagnosisChoice choice{.robot = choice_.robot};
  choice.add({offered_});
  choose(choice);
}

void RecordingPicker::addFiles(const QStringList& files) {
  DiagnosisChoice choice = choice_;
  choice.add(files);
  choose(choice);
}

void RecordingPicker::fillMenu() {
  menu_->clear();
  menu_->addAction(tr("Add recordings…"), this, &RecordingPicker::askRecordings);
  if (choice_.recordings.isEmpty()) return;
  menu_->addSeparator();
  for (const QString& path : choice_.recordings)
    menu_->addAction(tr("Remove %1").arg(QFileInfo(path).fileName()), this, [this, path] {
      DiagnosisChoice choice = choice_;
      choice.recordings.removeAll(path);
      choose(choice);
    });
  if (choice_.recordings.size() > 1)
    menu_->addAction(tr("Remove all"), this, [this] { choose({.robot = choice_.robot}); });
}

void RecordingPicker::askRecordings() {
  auto* dialog = new QFileDialog(this, tr("Recordings of one robot"), folderOf(choice_.recordings),
                                 tr("Recordings (*.capstan *.csv);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  connect(dialog, &QFileDialog::filesSelected, this, &RecordingPicker::addFiles);
  dialog->show();
}

void RecordingPicker::askRobot() {
  auto* dialog = new QFileDialog(
      this, tr("The nominal robot"),
      choice_.robot.isEmpty() ? folderOf(choice_.recordings) : QFileInfo(choice_.robot).path(),
      tr("Robot files (*.yaml);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& path) {
    DiagnosisChoice choice = choice_;
    choice.robot = QFileInfo(path).absoluteFilePath();
    choose(choice);
  });
  dialog->show();
}

void RecordingPicker::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void RecordingPicker::dropEvent(QDropEvent* event) {
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  addFiles(files);
}

void RecordingPicker::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  refresh();
}

void RecordingPicker::refresh() {
  QStringList names, paths;
  for (const QString& path : choice_.recordings) {
    names << QFileInfo(path).fileName();
    paths << QDir::toNativeSeparators(path);
  }
  const QString words = names.isEmpty() ? tr("none chosen yet") : names.join(QStringLiteral(", "));
  what_->setText(what_->fontMetrics().elidedText(words, Qt::ElideRight, what_->width()));
  what_->setToolTip(paths.join('\n'));
  offer_->setVisible(!offered_.isEmpty() && choice_.recordings != QStringList{offered_});
  offer_->setToolTip(tr("Diagnose %1 alone").arg(QFileInfo(offered_).fileName()));
  robot_->setText((choice_.robot.isEmpty() ? tr("own robot") : QFileInfo(choice_.robot).completeBaseName()) +
                  QStringLiteral(" ▾"));
}

}  // namespace capstan::widgets
