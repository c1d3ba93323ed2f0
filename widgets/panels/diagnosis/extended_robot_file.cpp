#include "widgets/panels/diagnosis/extended_robot_file.h"

#include <QObject>
#include <QSaveFile>

#include "core/base/software.h"
#include "core/diagnosis/report/extended_robot.h"

namespace capstan::widgets {

bool saveExtendedRobot(const diagnosis::Report& report, const QString& path, QString& words) {
  const QByteArray content =
      QByteArray::fromStdString(diagnosis::extendedRobotText(report, base::software()));
  QSaveFile file(path);
  const bool saved =
      file.open(QIODevice::WriteOnly) && file.write(content) == content.size() && file.commit();
  words = saved ? QObject::tr("Saved as %1.").arg(path)
                : QObject::tr("%1 cannot be written (%2). Choose a folder that exists and has room.")
                      .arg(path, file.errorString());
  return saved;
}

}  // namespace capstan::widgets
