#pragma once

#include "widgets/panels/diagnosis/diagnosis_choice.h"
#include "widgets/panels/work/file_picker.h"

namespace capstan::widgets {

/// One line to choose the input of a diagnosis: recordings, the latest of the session among them, and a
/// robot.
class RecordingPicker : public FilePicker {
  Q_OBJECT

 public:
  explicit RecordingPicker(QWidget* parent = nullptr);

  const DiagnosisChoice& choice() const { return choice_; }
  /// Shows `choice`; emits no signal.
  void setChoice(const DiagnosisChoice& choice);
  /// Shows a button with the text `words` that chooses the recording `path` of the session alone, read in the
  /// units `read_as`, unless it is already chosen. If `path` is empty, there is no button.
  void offer(const QString& path, const QString& words, const QString& read_as = {});
  /// Replaces all chosen recordings by the offered one; does nothing without one.
  void takeOffered();
  /// Opens a non-modal file dialog.
  void askRobot();

 protected:
  QStringList& chosen() override { return choice_.recordings; }
  void refresh() override;

 private:
  void setRobot(const QString& robot);
  void setUnits(const QString& read_as);

  DiagnosisChoice choice_;
  QString offered_, offered_read_as_;
  QToolButton *offer_, *units_, *robot_;
};

}  // namespace capstan::widgets
