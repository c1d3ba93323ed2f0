#include "widgets/panels/work/folder_dialog.h"

#include <QDir>
#include <QFileInfo>

namespace capstan::widgets {

FolderDialog::FolderDialog(QWidget* parent, const QString& title, const QString& begin)
    : QFileDialog(parent, title, begin) {
  setAttribute(Qt::WA_DeleteOnClose);
  setFileMode(QFileDialog::Directory);
  setOption(QFileDialog::ShowDirsOnly);
  setLabelText(QFileDialog::FileName, tr("Folder (a new name is created):"));
}

/// QFileDialog refuses a folder that does not exist. A folder that cannot be created is refused there.
void FolderDialog::accept() {
  const QStringList folders = selectedFiles();
  if (folders.size() == 1 && !QFileInfo::exists(folders[0])) QDir().mkpath(folders[0]);
  QFileDialog::accept();
}

}  // namespace capstan::widgets
