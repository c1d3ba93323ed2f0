#include "widgets/shell/source_choice.h"

#include <QCoreApplication>
#include <QSettings>
#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "core/session/table_source.h"
#include "core/simulation/simulated_source.h"

namespace capstan::widgets {

namespace {

/// A file of the resources folder: CAPSTAN_RESOURCES of the environment, beside the program, or the source
/// tree.
std::filesystem::path resource(const char* file) {
  const auto installed = QCoreApplication::applicationDirPath().toStdString() + "/../share/capstan";
  const char* given = std::getenv("CAPSTAN_RESOURCES");
  for (const std::filesystem::path root :
       {std::string(given ? given : ""), installed, std::string(CAPSTAN_RESOURCES)})
    if (!root.empty() && std::filesystem::exists(root / file)) return root / file;
  throw base::InputError({file,
                          0,
                          {},
                          {},
                          "is in no resource folder",
                          "Set CAPSTAN_RESOURCES to the resources folder of Capstan."});
}

}  // namespace

void SourceChoice::save(QSettings& settings) const {
  settings.setValue("source/simulated", simulated);
  settings.setValue("source/file", file);
  settings.setValue("source/trajectory", trajectory);
  settings.setValue("source/truth", truth);
  settings.setValue("source/seed", seed);
  settings.setValue("source/duration", duration);
}

SourceChoice SourceChoice::restore(const QSettings& settings) {
  SourceChoice choice;
  choice.simulated = settings.value("source/simulated", choice.simulated).toBool();
  choice.file = settings.value("source/file").toString();
  choice.trajectory = settings.value("source/trajectory", choice.trajectory).toString();
  choice.truth = settings.value("source/truth", choice.truth).toString();
  choice.seed = settings.value("source/seed", choice.seed).toUInt();
  choice.duration = settings.value("source/duration", choice.duration).toDouble();
  return choice;
}

std::unique_ptr<session::Source> openSource(const SourceChoice& choice) {
  const auto robot = robot::readDescription(resource("robots/raven2_left.yaml"));
  if (!choice.simulated) return session::openRecording(choice.file.toStdString(), robot);
  using Kind = simulation::TrajectoryKind;
  simulation::SimulatedOptions options;
  options.robot = robot;
  options.truth = choice.truth == "matched" ? simulation::matchedTruth() : simulation::defaultTruth();
  options.trajectory.kind = choice.trajectory == "sinusoid" ? Kind::kSinusoid
                            : choice.trajectory == "hold"   ? Kind::kHold
                                                            : Kind::kBlockTransfer;
  options.trajectory.duration = choice.duration;
  options.seed = choice.seed;
  options.rig = vision::readStereoRig(resource("cameras/left.yaml"), resource("cameras/right.yaml"));
  return std::make_unique<simulation::SimulatedSource>(options);
}

}  // namespace capstan::widgets
