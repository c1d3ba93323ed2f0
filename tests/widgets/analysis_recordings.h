#pragma once

#include <QTemporaryDir>
#include <fstream>

#include "core/recording/export.h"
#include "core/simulation/simulation_request.h"

namespace capstan::widgets {

/// A short simulated recording, made once.
class Recordings {
 public:
  Recordings() {
    simulation::SimulationRequest request;
    request.trajectory = "sinusoid";
    request.duration = 8.0;
    request.images = false;
    simulation::SimulatedSource source(simulation::optionsOf(request));
    robot = source.info().robot;
    recording::importRecording(source, path("trial.capstan").toStdString(),
                               recording::headerOf(source.info(), "today"));
    robot.drives[0].link_radius *= 0.97;
    std::ofstream(path("mine.yaml").toStdString()) << robot::formatDescription(robot);
  }
  QString path(const QString& name) const { return folder_.filePath(name); }
  static Recordings& get() {
    static Recordings recordings;
    return recordings;
  }
  robot::Description robot;

 private:
  QTemporaryDir folder_;
};

}  // namespace capstan::widgets
