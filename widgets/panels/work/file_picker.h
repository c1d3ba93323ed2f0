#pragma once

#include <QFileDialog>
#include <QStringList>
#include <QWidget>

#include "widgets/figures/theme.h"

class QHBoxLayout;
class QLabel;
class QMenu;
class QToolButton;

namespace capstan::widgets {

/// One line to choose files: a button whose menu adds and removes them, and their names. Files can also be
/// dropped on it. A subclass stores the files and adds its other choices to row().
class FilePicker : public QWidget {
  Q_OBJECT

 public:
  void setTheme(const Theme& theme);
  /// Opens a non-modal file dialog that adds files.
  void askFiles();

 signals:
  void changed();

 protected:
  struct Words {
    QString object;  ///< object name of the button
    QString noun;    ///< what is chosen, in the plural: "tables"
    QString tip;     ///< the same in more words
    QString title;   ///< of the file dialog
    QString filter;  ///< of the file dialog
  };
  FilePicker(const Words& words, QWidget* parent);

  /// The chosen files: absolute paths, each once.
  virtual QStringList& chosen() = 0;
  /// Shows the choice; a constructor of a subclass calls it too.
  virtual void refresh();
  void setFiles(const QStringList& files);
  void setFilesVisible(bool visible);

  QHBoxLayout* row() { return row_; }
  static QToolButton* menuButton(const QString& name, const QString& tip, QMenu* menu);
  /// Shows a dialog in the folder of the last of `beside`.
  QFileDialog* ask(const QString& title, const QStringList& beside, const QString& filter,
                   QFileDialog::FileMode mode);

  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void addFiles(const QStringList& files);
  void fillMenu();

  const Words words_;
  QHBoxLayout* row_;
  QMenu* menu_;
  QToolButton* button_;
  QLabel* names_;
};

}  // namespace capstan::widgets
