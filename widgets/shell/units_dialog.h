#pragma once

#include <QDialog>
#include <vector>

#include "core/recording/settle_units.h"

class QComboBox;

namespace capstan::widgets {

/// Non-modal dialog that asks for the units of table columns that can hardly be in SI units. It shows for
/// each column the values found and a choice. Nothing is opened before the choice is made.
class UnitsDialog : public QDialog {
  Q_OBJECT

 public:
  UnitsDialog(const recording::ImplausibleUnits& refused, QWidget* parent = nullptr);
  /// The present choice for every column, in the format of recording::parseReadAs().
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
