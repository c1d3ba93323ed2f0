#include "widgets/panels/learning/learning_choice.h"

#include <QObject>
#include <QSettings>

namespace capstan::widgets {

using learning::StreamKind;

void LearningChoice::save(QSettings& settings) const {
  settings.setValue("learning/tables", tables);
  settings.setValue("learning/told", QString::fromStdString(std::string(base::nameOf(towards))));
}

LearningChoice LearningChoice::restore(const QSettings& settings) {
  const bool robot = settings.value("learning/told").toString() == QLatin1String("robot");
  return {settings.value("learning/tables").toStringList(),
          robot ? StreamKind::kRobot : StreamKind::kCommand};
}

QString nameOf(StreamKind stream) {
  switch (stream) {
    case StreamKind::kCamera:
      return QObject::tr("camera");
    case StreamKind::kRobot:
      return QObject::tr("robot's kinematics");
    case StreamKind::kCommand:
      return QObject::tr("command");
  }
  return {};
}

}  // namespace capstan::widgets
