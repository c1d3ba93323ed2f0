#include "widgets/shell/source_choice.h"

#include <QFileInfo>
#include <QSettings>

#include "core/live/live_source.h"
#include "core/recording/table_source.h"

namespace capstan::widgets {

namespace {

/// Absolute path of a file; empty stays empty.
QString absolute(const QString& path) { return path.isEmpty() ? path : QFileInfo(path).absoluteFilePath(); }

/// Absolute path of a file; names of built-in choices stay as they are.
QString absoluteUnlessName(const std::string& text) {
  const QString path = QString::fromStdString(text);
  return path.contains('.') || path.contains('/') ? absolute(path) : path;
}

}  // namespace

SourceChoice SourceChoice::ofFile(const QString& file) {
  SourceChoice choice;
  choice.simulated = false;
  choice.file = absolute(file);
  return choice;
}

SourceChoice SourceChoice::ofLive(const QString& live) {
  SourceChoice choice;
  choice.simulated = false;
  choice.live = live;
  return choice;
}

SourceChoice SourceChoice::ofSimulation(const simulation::SimulationRequest& request) {
  SourceChoice choice;
  choice.simulation = request;
  return choice;
}

void SourceChoice::save(QSettings& settings) const {
  if (!live.isEmpty()) return;
  settings.setValue("source/simulated", simulated);
  settings.setValue("source/file", absolute(file));
  settings.setValue("source/read_as", read_as);
  settings.setValue("source/robot", absolute(robot));
  settings.setValue("simulation/trajectory", absoluteUnlessName(simulation.trajectory));
  settings.setValue("simulation/duration", simulation.duration);
  settings.setValue("simulation/truth", absoluteUnlessName(simulation.truth));
  settings.setValue("simulation/seed", static_cast<qulonglong>(simulation.seed));
  settings.setValue("simulation/robot", absolute(QString::fromStdString(simulation.robot.string())));
  settings.setValue("simulation/registered", simulation.registered);
  settings.setValue("simulation/distractors", simulation.distractors);
  settings.setValue("simulation/uneven_light", simulation.uneven_light);
}

SourceChoice SourceChoice::restore(const QSettings& settings) {
  SourceChoice choice;
  const auto text = [&](const char* key, const std::string& otherwise) {
    return settings.value(key, QString::fromStdString(otherwise)).toString().toStdString();
  };
  auto& request = choice.simulation;
  choice.simulated = settings.value("source/simulated", choice.simulated).toBool();
  choice.file = settings.value("source/file").toString();
  choice.read_as = settings.value("source/read_as").toString();
  choice.robot = settings.value("source/robot").toString();
  request.trajectory = text("simulation/trajectory", request.trajectory);
  request.duration = settings.value("simulation/duration", request.duration).toDouble();
  request.truth = text("simulation/truth", request.truth);
  request.seed = settings.value("simulation/seed", static_cast<qulonglong>(request.seed)).toULongLong();
  request.robot = text("simulation/robot", {});
  request.registered = settings.value("simulation/registered", request.registered).toBool();
  request.distractors = settings.value("simulation/distractors", request.distractors).toBool();
  request.uneven_light = settings.value("simulation/uneven_light", request.uneven_light).toBool();
  return choice;
}

QString titleOf(const SourceChoice& choice, const std::string& own_title) {
  const QString own = QString::fromStdString(own_title);
  if (!choice.live.isEmpty()) return QObject::tr("live %1").arg(own);
  if (choice.simulated || choice.file.isEmpty()) return own;
  const QFileInfo file(choice.file);
  const bool more = own != file.fileName() && own != file.completeBaseName();
  return more ? QObject::tr("recording %1 of %2").arg(file.fileName(), own)
              : QObject::tr("recording %1").arg(file.fileName());
}

std::unique_ptr<tracking::Source> openSource(const SourceChoice& choice) {
  if (choice.simulated)
    return std::make_unique<simulation::SimulatedSource>(simulation::optionsOf(choice.simulation));
  if (!choice.live.isEmpty())
    return std::make_unique<live::LiveSource>(live::liveSetupOf(
        choice.live.toStdString(), choice.robot.toStdString(), choice.read_as.toStdString()));
  return recording::openRecording(
      choice.file.toStdString(), robot::readDescriptionOrDefault(choice.robot.toStdString()),
      recording::parseReadAs(choice.read_as.toStdString(), choice.file.toStdString()));
}

}  // namespace capstan::widgets
