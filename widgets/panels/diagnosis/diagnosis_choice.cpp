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
}

DiagnosisChoice DiagnosisChoice::restore(const QSettings& settings) {
  DiagnosisChoice choice;
  choice.material = settings.value("diagnosis/material", choice.material).toString();
  return choice;
}

diagnosis::Tolerance toleranceOf(const QString& material) {
  return diagnosis::parseTolerance(material.toStdString(), "tolerance");
}

}  // namespace capstan::widgets
