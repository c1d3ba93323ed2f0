#include "widgets/panels/diagnosis/report_files.h"

#include <QObject>
#include <QSaveFile>
#include <string>

#include "core/base/software.h"
#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/report/extended_robot.h"

namespace capstan::widgets {

namespace {

bool saveText(const std::string& text, const QString& path, QString& words) {
  const QByteArray content = QByteArray::fromStdString(text);
  QSaveFile file(path);
  const bool saved =
      file.open(QIODevice::WriteOnly) && file.write(content) == content.size() && file.commit();
  words = saved ? QObject::tr("Saved as %1.").arg(path)
                : QObject::tr("%1 cannot be written (%2). Choose a folder that exists and has room.")
                      .arg(path, file.errorString());
  return saved;
}

}  // namespace

bool saveExtendedRobot(const diagnosis::Report& report, const QString& path, QString& words) {
  return saveText(diagnosis::extendedRobotText(report, base::software()), path, words);
}

bool saveNextExperiment(const diagnosis::NextExperiment& next, const QString& path, QString& words) {
  return saveText(diagnosis::trajectoryText(next), path, words);
}

}  // namespace capstan::widgets
