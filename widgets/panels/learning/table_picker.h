#pragma once

#include "widgets/panels/learning/learning_choice.h"
#include "widgets/panels/work/file_picker.h"

class QComboBox;

namespace capstan::widgets {

/// One line to choose the input of learning: tables of tip poses, and the stream to correct towards.
class TablePicker : public FilePicker {
  Q_OBJECT

 public:
  explicit TablePicker(QWidget* parent = nullptr);

  const LearningChoice& choice() const { return choice_; }
  /// Shows `choice`; emits no signal.
  void setChoice(const LearningChoice& choice);

 protected:
  QStringList& chosen() override { return choice_.tables; }
  void refresh() override;

 private:
  LearningChoice choice_;
  QComboBox* towards_;
};

}  // namespace capstan::widgets
