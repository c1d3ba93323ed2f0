#include "widgets/panels/learning/table_picker.h"

#include <QBoxLayout>
#include <QComboBox>
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

using learning::StreamKind;

TablePicker::TablePicker(QWidget* parent) : QWidget(parent), menu_(new QMenu(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  tables_ = new QToolButton;
  tables_->setObjectName("tables");
  tables_->setText(tr("Tables ▾"));
  tables_->setToolTip(tr("Add or remove tables of tip poses (Ctrl+Shift+O adds); or drop files here"));
  tables_->setPopupMode(QToolButton::InstantPopup);
  tables_->setMenu(menu_);
  what_ = new QLabel;
  what_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  what_->setAccessibleName(tr("tables chosen"));
  towards_ = new QComboBox;
  towards_->setObjectName("towards");
  for (const StreamKind stream : {StreamKind::kCommand, StreamKind::kRobot})
    towards_->addItem(tr("towards the %1").arg(nameOf(stream)), static_cast<int>(stream));
  towards_->setToolTip(
      tr("Stream to correct towards: the command, or the pose from the robot's forward kinematics"));
  row->addWidget(tables_);
  row->addWidget(what_, 1);
  row->addWidget(towards_);
  setAcceptDrops(true);
  connect(menu_, &QMenu::aboutToShow, this, &TablePicker::fillMenu);
  connect(towards_, QOverload<int>::of(&QComboBox::activated), this, [this] {
    LearningChoice choice = choice_;
    choice.towards = static_cast<StreamKind>(towards_->currentData().toInt());
    choose(choice);
  });
  connect(new QShortcut(QKeySequence(QStringLiteral("Ctrl+Shift+O")), this), &QShortcut::activated, this,
          &TablePicker::askTables);
  refresh();
}

void TablePicker::setTheme(const Theme& theme) {
  QPalette palette = what_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  what_->setPalette(palette);
}

void TablePicker::choose(const LearningChoice& choice) {
  const bool differs = !(choice == choice_);
  setChoice(choice);
  if (differs) Q_EMIT changed();
}

void TablePicker::setChoice(const LearningChoice& choice) {
  choice_ = choice;
  refresh();
}

void TablePicker::addFiles(const QStringList& files) {
  LearningChoice choice = choice_;
  choice.add(files);
  choose(choice);
}

void TablePicker::fillMenu() {
  menu_->clear();
  menu_->addAction(tr("Add tables…"), this, &TablePicker::askTables);
  if (choice_.tables.isEmpty()) return;
  menu_->addSeparator();
  for (const QString& path : choice_.tables)
    menu_->addAction(tr("Remove %1").arg(QFileInfo(path).fileName()), this, [this, path] {
      LearningChoice choice = choice_;
      choice.tables.removeAll(path);
      choose(choice);
    });
  if (choice_.tables.size() > 1)
    menu_->addAction(tr("Remove all"), this, [this] { choose({{}, choice_.towards}); });
}

void TablePicker::askTables() {
  auto* dialog =
      new QFileDialog(this, tr("Tables of tip poses of one robot"),
                      choice_.tables.isEmpty() ? QString() : QFileInfo(choice_.tables.back()).path(),
                      tr("Tables (*.csv);;All files (*)"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFiles);
  connect(dialog, &QFileDialog::filesSelected, this, &TablePicker::addFiles);
  dialog->show();
}

void TablePicker::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void TablePicker::dropEvent(QDropEvent* event) {
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  addFiles(files);
}

void TablePicker::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  refresh();
}

void TablePicker::refresh() {
  QStringList names, paths;
  for (const QString& path : choice_.tables) {
    names << QFileInfo(path).fileName();
    paths << QDir::toNativeSeparators(path);
  }
  const QString words = names.isEmpty() ? tr("none chosen yet") : names.join(QStringLiteral(", "));
  what_->setText(what_->fontMetrics().elidedText(words, Qt::ElideRight, what_->width()));
  what_->setToolTip(paths.join('\n'));
  towards_->setCurrentIndex(towards_->findData(static_cast<int>(choice_.towards)));
}

}  // namespace capstan::widgets
