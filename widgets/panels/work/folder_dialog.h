#pragma once

#include <QFileDialog>

namespace capstan::widgets {

/// File dialog that chooses a folder to write into. A typed name that does not exist yet is created as a new
/// folder when the dialog is accepted.
class FolderDialog : public QFileDialog {
  Q_OBJECT

 public:
  FolderDialog(QWidget* parent, const QString& title, const QString& begin = {});
  void accept() override;
};

}  // namespace capstan::widgets
