#pragma once

#include <QDialog>
#include <vector>

#include "core/recording/settle_units.h"

class QComboBox;

namespace capstan::widgets {

/// Asks how the columns of a table are to be read that can hardly be in SI units: what was found of each, and
/// a choice. Not modal; nothing is opened before the choice is made.
class UnitsDialog : public QDialog {
  Q_OBJECT

 public:
  UnitsDialog(const recording::ImplausibleUnits& refused, QWidget* parent = nullptr);
  /// What is chosen now, of every column that was requested, as recording::parseReadAs() takes it.
  QString readAs() const;

 signals:
  void chosen(const QString& read_as);

 private:
  struct Row {
    QString column;
    QComboBox* choice;
  };
  QComboBox* choiceOf(const recording::UnitFinding& finding);

  std::vector<Row> rows_;
};

}  // namespace capstan::widgets
