#pragma once

#include <QWidget>

class QComboBox;

namespace capstan::widgets {

/// Chooses the effort of the search for causes: the factor on its limit, as capstan-cli diagnose --effort.
class EffortBox : public QWidget {
  Q_OBJECT

 public:
  explicit EffortBox(QWidget* parent = nullptr);

  double effort() const;
  /// Shows `effort`, also one that is not in the list; emits no signal.
  void setEffort(double effort);

 signals:
  void changed();

 private:
  QComboBox* box_;
};

}  // namespace capstan::widgets
