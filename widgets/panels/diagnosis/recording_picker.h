#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"

class QLabel;
class QMenu;
class QToolButton;

namespace capstan::widgets {

/// One line that chooses what is diagnosed: recordings, the one just made among them, and a robot.
class RecordingPicker : public QWidget {
  Q_OBJECT

 public:
  explicit RecordingPicker(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  const DiagnosisChoice& choice() const { return choice_; }
  /// Shows `choice`, without a signal.
  void setChoice(const DiagnosisChoice& choice);
  /// A recording of the session, offered as long as it is not what is chosen; `words` on its button. Empty:
  /// there is none.
  void offer(const QString& path, const QString& words);
  /// Puts the offered recording in the place of all others; does nothing without one.
  void takeOffered();
  /// Ask for files beside the program's other windows.
  void askRecordings();
  void askRobot();

 signals:
  void changed();

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void choose(const DiagnosisChoice& choice);
  void addFiles(const QStringList& files);
  void fillMenu();
  void refresh();

  DiagnosisChoice choice_;
  QString offered_;
  QToolButton *recordings_, *offer_, *robot_;
  QMenu* menu_;
  QLabel* what_;
};

}  // namespace capstan::widgets
