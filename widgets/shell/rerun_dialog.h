#pragma once

#include <QDialog>

#include "core/analysis/rerun.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLineEdit;

namespace capstan::widgets {

/// Asks what is different when the session is tracked again: robot, filter options, filter, gate, latency.
/// What is left alone stays as the session has it.
class RerunDialog : public QDialog {
  Q_OBJECT

 public:
  explicit RerunDialog(QWidget* parent = nullptr);
  analysis::RerunChange change() const;

 signals:
  void chosen(const capstan::analysis::RerunChange& change);

 private:
  QLineEdit* addFile(QFormLayout* form, const QString& label, const QString& filter);
  QComboBox* addChoice(QFormLayout* form, const QString& label, const QStringList& names);
  QDoubleSpinBox* addNumber(QFormLayout* form, const QString& label, QCheckBox*& on);

  QLineEdit *robot_, *options_;
  QComboBox *filter_, *one_camera_;
  QCheckBox *gate_on_, *delay_on_;
  QDoubleSpinBox *gate_, *delay_;
};

}  // namespace capstan::widgets
