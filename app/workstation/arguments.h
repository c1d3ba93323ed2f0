#pragma once

#include <CLI/CLI.hpp>
#include <QSize>
#include <string>

#include "widgets/shell/source_choice.h"

namespace capstan::workstation {

/// What the command line of the window says.
struct Arguments {
  std::string file, robot, theme, image, size = "1920x1080", state = "running";
  simulation::SimulationRequest simulation;
  bool simulate = false;  ///< requested, or implied by an option of the simulation
  double after = 12.0;    ///< [s]
};

/// Declares the options on `cli`. Options that mean nothing together, or alone, are refused by its parse().
void addOptions(CLI::App& cli, Arguments& arguments);
/// After parse(): an option that describes a simulation, or a robot for no recording, asks for a simulation.
void imply(const CLI::App& cli, Arguments& arguments);
/// What is to be opened; `last` where the command line names nothing.
widgets::SourceChoice choiceOf(const Arguments& arguments, const widgets::SourceChoice& last);
/// Width and height of --size. Throws base::InputError.
QSize sizeOf(const std::string& text);

}  // namespace capstan::workstation
