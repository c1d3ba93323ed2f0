#include "widgets/panels/diagnosis/diagnosis_choice.h"

#include <QFileInfo>
#include <QSettings>

namespace capstan::widgets {

void DiagnosisChoice::add(const QStringList& files) {
  for (const QString& file : files)
    if (const QString path = QFileInfo(file).absoluteFilePath(); !recordings.contains(path))
      recordings << path;
}

void DiagnosisChoice::save(QSettings& settings) const {
  settings.setValue("diagnosis/material", material);
  settings.setValue("diagnosis/effort", effort);
}

DiagnosisChoice DiagnosisChoice::restore(const QSettings& settings) {
  DiagnosisChoice choice;
  choice.material = settings.value("diagnosis/material", choice.material).toString();
  constexpr double kLeast = 0.01, kMost = 1e6;  // as of --effort
  const double effort = settings.value("diagnosis/effort", choice.effort).toDouble();
  if (effort >= kLeast && effort <= kMost) choice.effort = effort;
  return choice;
}

diagnosis::Tolerance toleranceOf(const QString& material) {
  return diagnosis::parseTolerance(material.toStdString(), "tolerance");
}

}  // namespace capstan::widgets
