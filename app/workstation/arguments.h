#pragma once

#include <CLI/CLI.hpp>
#include <QSize>
#include <string>
#include <vector>

#include "widgets/shell/source_choice.h"

namespace capstan::workstation {

/// Arguments of the window's command line.
struct Arguments {
  std::vector<std::string> publish;
  std::string file, live, robot, monitor_feed, theme, image, size = "1920x1080", state = "running", show;
  simulation::SimulationRequest simulation;
  bool simulate = false;  ///< --simulate, or implied by an option of the simulation
  double after = 12.0;    ///< time until the picture is saved [s]
};

/// Declares the options on `cli`. Its parse() refuses options that exclude each other or need another one.
void addOptions(CLI::App& cli, Arguments& arguments);
/// Sets `arguments.simulate`, after parse(): without a file, an option of the simulation, a robot or a
/// screenshot implies a simulation.
void imply(const CLI::App& cli, Arguments& arguments);
/// Source to open; `last` if the command line names none.
widgets::SourceChoice choiceOf(const Arguments& arguments, const widgets::SourceChoice& last);
/// Width and height of --size [px]. Throws base::InputError.
QSize sizeOf(const std::string& text);

}  // namespace capstan::workstation
