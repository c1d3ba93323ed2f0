#pragma once

#include <QString>
#include <memory>

#include "core/simulation/simulation_request.h"
#include "core/tracking/source.h"

class QSettings;

namespace capstan::widgets {

/// Source that the user opens; saved in the settings.
struct SourceChoice {
  bool simulated = true;
  simulation::SimulationRequest simulation;
  QString live;     ///< live set-up file or address of a robot that sends its samples now; empty: none
  QString file;     ///< file of a session or measured table, if neither simulated nor live
  QString read_as;  ///< units of a table, as recording::parseReadAs() takes them; empty: SI
  QString robot;    ///< robot file for a recording that brings none; empty: the left RAVEN-II

  static SourceChoice ofFile(const QString& file);
  static SourceChoice ofLive(const QString& live);
  static SourceChoice ofSimulation(const simulation::SimulationRequest& request);

  bool isRecording() const { return !simulated && live.isEmpty() && !file.isEmpty(); }

  /// A live source is not saved: the program listens only when it is asked to.
  void save(QSettings& settings) const;
  static SourceChoice restore(const QSettings& settings);

  bool operator==(const SourceChoice&) const = default;
};

/// Title of the source in the window: for a recording its file name, and its own title if that says more.
QString titleOf(const SourceChoice& choice, const std::string& own_title);

/// Opens the source. Takes some time (a simulation registers its cameras first). Throws
/// recording::ImplausibleUnits and other base::InputError.
std::unique_ptr<tracking::Source> openSource(const SourceChoice& choice);

}  // namespace capstan::widgets
