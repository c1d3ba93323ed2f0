#pragma once

#include "core/experiments/correction_experiment.h"
#include "widgets/panels/work/file_picker.h"

class QComboBox;

namespace capstan::widgets {

/// One line to choose an experiment E to H and, for E and F, tables of tip poses and the stream to compare
/// poses with.
class ExperimentPicker : public FilePicker {
  Q_OBJECT

 public:
  explicit ExperimentPicker(QWidget* parent = nullptr);

  experiments::CorrectionExperiment experiment() const;
  learning::StreamKind towards() const;
  const QStringList& tables() const { return tables_; }
  /// Whether the choice can be run: E and F need a table.
  bool complete() const;

  void choose(experiments::CorrectionExperiment experiment);
  void setTables(const QStringList& tables) { setFiles(tables); }
  void setTowards(learning::StreamKind towards);

 protected:
  QStringList& chosen() override { return tables_; }
  void refresh() override;

 private:
  QStringList tables_;
  QComboBox *experiment_, *towards_;
};

}  // namespace capstan::widgets
