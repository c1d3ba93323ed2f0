#pragma once

#include <QStringList>
#include <QWidget>

#include "core/experiments/correction_experiment.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace capstan::widgets {

/// One line to choose an experiment E to H and, for E and F, tables of tip poses and the stream to compare
/// poses with.
class ExperimentPicker : public QWidget {
  Q_OBJECT

 public:
  explicit ExperimentPicker(QWidget* parent = nullptr);

  experiments::CorrectionExperiment experiment() const;
  learning::StreamKind towards() const;
  const QStringList& tables() const { return tables_; }
  /// Whether the choice can be run: E and F need a table.
  bool complete() const;

  void choose(experiments::CorrectionExperiment experiment);
  void setTables(const QStringList& tables);
  void setTowards(learning::StreamKind towards);
  /// Opens a non-modal file dialog.
  void askTables();

 signals:
  void changed();

 private:
  void refresh();

  QStringList tables_;
  QComboBox *experiment_, *towards_;
  QToolButton* ask_;
  QLabel* names_;
};

}  // namespace capstan::widgets
