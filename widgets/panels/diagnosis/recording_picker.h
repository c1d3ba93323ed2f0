#pragma once

#include <QWidget>

#include "widgets/figures/theme.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"

class QLabel;
class QMenu;
class QToolButton;

namespace capstan::widgets {

/// One line to choose the input of a diagnosis: recordings, the latest of the session among them, and a
/// robot.
class RecordingPicker : public QWidget {
  Q_OBJECT

 public:
  explicit RecordingPicker(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  const DiagnosisChoice& choice() const { return choice_; }
  /// Shows `choice`; emits no signal.
  void setChoice(const DiagnosisChoice& choice);
  /// Offers a recording of the session, unless it is already chosen; `words`: text of its button. Empty:
  /// none.
  void offer(const QString& path, const QString& words);
  /// Replaces all chosen recordings by the offered one; does nothing without one.
  void takeOffered();
  /// Open non-modal file dialogs.
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
