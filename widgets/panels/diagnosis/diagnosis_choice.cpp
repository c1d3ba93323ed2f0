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
  settings.setValue("diagnosis/recordings", recordings);
  settings.setValue("diagnosis/robot", robot);
}

DiagnosisChoice DiagnosisChoice::restore(const QSettings& settings) {
  return {settings.value("diagnosis/recordings").toStringList(),
          settings.value("diagnosis/robot").toString()};
}

}  // namespace capstan::widgets
