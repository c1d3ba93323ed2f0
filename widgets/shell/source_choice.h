#pragma once

#include <QString>
#include <memory>

#include "core/simulation/simulation_request.h"
#include "core/tracking/source.h"

class QSettings;

namespace capstan::widgets {

/// What the user asked to open; kept between starts.
struct SourceChoice {
  bool simulated = true;
  simulation::SimulationRequest simulation;
  QString file;     ///< session or measured table, where not simulated
  QString read_as;  ///< units of a table, as recording::parseReadAs() takes them; empty: SI
  QString robot;    ///< robot file for a recording that brings none; empty: the left RAVEN-II

  static SourceChoice ofFile(const QString& file);
  static SourceChoice ofSimulation(const simulation::SimulationRequest& request);

  void save(QSettings& settings) const;
  static SourceChoice restore(const QSettings& settings);

  bool operator==(const SourceChoice&) const = default;
};

/// What the window calls it: a recording by its file, and by what it says of itself where that is more.
QString titleOf(const SourceChoice& choice, const std::string& own_title);

/// Opens it. Takes a moment (a simulation registers its cameras first). Throws recording::ImplausibleUnits
/// and other base::InputError.
std::unique_ptr<tracking::Source> openSource(const SourceChoice& choice);

}  // namespace capstan::widgets
