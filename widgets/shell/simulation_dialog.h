#pragma once

#include <QDialog>

#include "core/simulation/simulation_request.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QSpinBox;

namespace capstan::widgets {

/// Non-modal dialog for a simulated session: trajectory, true robot, nominal robot file, seed, scene.
class SimulationDialog : public QDialog {
  Q_OBJECT

 public:
  explicit SimulationDialog(QWidget* parent = nullptr);

  void setRequest(const simulation::SimulationRequest& request);
  simulation::SimulationRequest request() const;

 signals:
  void chosen(const capstan::simulation::SimulationRequest& request);

 private:
  /// A list of names, with "file…" at its end; a chosen file becomes an entry of its own.
  QComboBox* addChoice(QFormLayout* form, const QString& label, const QList<QPair<QString, QString>>& names,
                       const QString& filter);
  void askFile(QComboBox* box, const QString& filter);

  QComboBox *trajectory_, *truth_, *robot_;
  QDoubleSpinBox* duration_;
  QSpinBox* seed_;
  QCheckBox *registered_, *distractors_, *uneven_light_;
};

}  // namespace capstan::widgets
