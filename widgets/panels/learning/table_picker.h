#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"
#include "widgets/panels/learning/learning_choice.h"

class QComboBox;
class QLabel;
class QMenu;
class QToolButton;

namespace capstan::widgets {

/// One line to choose the input of learning: tables of tip poses, and the stream to correct towards.
class TablePicker : public QWidget {
  Q_OBJECT

 public:
  explicit TablePicker(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  const LearningChoice& choice() const { return choice_; }
  /// Shows `choice`; emits no signal.
  void setChoice(const LearningChoice& choice);
  /// Opens a non-modal file dialog.
  void askTables();

 signals:
  void changed();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void choose(const LearningChoice& choice);
  void addFiles(const QStringList& files);
  void fillMenu();
  void refresh();

  LearningChoice choice_;
  QToolButton* tables_;
  QMenu* menu_;
  QLabel* what_;
  QComboBox* towards_;
};

}  // namespace capstan::widgets
