#include "widgets/panels/work/file_picker.h"

#include <QBoxLayout>
#include <QDir>
#include <QDragEnterEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QShortcut>
#include <QToolButton>

namespace capstan::widgets {

FilePicker::FilePicker(const Words& words, QWidget* parent)
    : QWidget(parent),
      words_(words),
      row_(new QHBoxLayout(this)),
      menu_(new QMenu(this)),
      button_(menuButton(words.object,
                         tr("Add or remove %1 (Ctrl+Shift+O adds); or drop files here").arg(words.tip),
                         menu_)),
      names_(new QLabel) {
  row_->setContentsMargins(0, 0, 0, 0);
  row_->setSpacing(6);
  button_->setText(tr("%1 ▾").arg(words.noun.left(1).toUpper() + words.noun.mid(1)));
  names_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  names_->setAccessibleName(tr("%1 chosen").arg(words.noun));
  row_->addWidget(button_);
  row_->addWidget(names_, 1);
  setAcceptDrops(true);
  connect(menu_, &QMenu::aboutToShow, this, &FilePicker::fillMenu);
  connect(new QShortcut(QKeySequence(QStringLiteral("Ctrl+Shift+O")), button_), &QShortcut::activated, this,
          &FilePicker::askFiles);
}

void FilePicker::setTheme(const Theme& theme) {
  QPalette palette = names_->palette();
  palette.setColor(QPalette::WindowText, theme.muted);
  names_->setPalette(palette);
}

void FilePicker::setFiles(const QStringList& files) {
  if (files == chosen()) return;
  chosen() = files;
  refresh();
  Q_EMIT changed();
}

void FilePicker::addFiles(const QStringList& files) {
  QStringList all = chosen();
  for (const QString& file : files) all << QFileInfo(file).absoluteFilePath();
  all.removeDuplicates();
  setFiles(all);
}

void FilePicker::setFilesVisible(bool visible) {
  button_->setVisible(visible);
  names_->setVisible(visible);
  setAcceptDrops(visible);
}

void FilePicker::fillMenu() {
  menu_->clear();
  menu_->addAction(tr("Add %1…").arg(words_.noun), this, &FilePicker::askFiles);
  if (chosen().isEmpty()) return;
  menu_->addSeparator();
  for (const QString& path : chosen())
    menu_->addAction(tr("Remove %1").arg(QFileInfo(path).fileName()), this, [this, path] {
      QStringList others = chosen();
      others.removeAll(path);
      setFiles(others);
    });
  if (chosen().size() > 1) menu_->addAction(tr("Remove all"), this, [this] { setFiles({}); });
}

QToolButton* FilePicker::menuButton(const QString& name, const QString& tip, QMenu* menu) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setMenu(menu);
  return button;
}

QFileDialog* FilePicker::ask(const QString& title, const QStringList& beside, const QString& filter,
                             QFileDialog::FileMode mode) {
  auto* dialog =
      new QFileDialog(this, title, beside.isEmpty() ? QString() : QFileInfo(beside.back()).path(), filter);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(mode);
  dialog->open();
  return dialog;
}

void FilePicker::askFiles() {
  connect(ask(words_.title, chosen(), words_.filter, QFileDialog::ExistingFiles), &QFileDialog::filesSelected,
          this, &FilePicker::addFiles);
}

void FilePicker::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void FilePicker::dropEvent(QDropEvent* event) {
  QStringList files;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  addFiles(files);
}

void FilePicker::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  refresh();
}

void FilePicker::refresh() {
  QStringList names, paths;
  for (const QString& path : chosen()) {
    names << QFileInfo(path).fileName();
    paths << QDir::toNativeSeparators(path);
  }
  const QString text = names.isEmpty() ? tr("none chosen yet") : names.join(QStringLiteral(", "));
  names_->setText(names_->fontMetrics().elidedText(text, Qt::ElideRight, names_->width()));
  names_->setToolTip(paths.join('\n'));
}

}  // namespace capstan::widgets
