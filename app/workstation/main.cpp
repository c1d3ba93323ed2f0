#include <CLI/CLI.hpp>
#include <QApplication>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "widgets/shell/main_window.h"

namespace {

struct Arguments {
  std::string file, robot, theme, picture, size = "1920x1080", state = "running";
  capstan::simulation::SimulationRequest simulation;
  bool simulate = false;
  double after = 12.0;
};

/// Brings the window into the state asked for, grabs it and quits.
void planPicture(capstan::widgets::MainWindow& window, const Arguments& arguments) {
  const int after = static_cast<int>(arguments.after * 1e3);
  if (arguments.state == "occluded")
    QTimer::singleShot(after * 3 / 4, Qt::PreciseTimer, &window, [&window] {
      if (window.link().runner()) window.link().runner()->block(true, false);
    });
  if (arguments.state == "paused")
    QTimer::singleShot(after - 800, Qt::PreciseTimer, &window,
                       [&window] { window.link().setRunning(false); });
  QTimer::singleShot(after, Qt::PreciseTimer, &window, [&window, &arguments] {
    const bool saved = window.grab().save(QString::fromStdString(arguments.picture));
    if (!saved) std::cerr << "capstan: " << arguments.picture << " cannot be written\n";
    QApplication::exit(saved ? 0 : 2);
  });
}

void addOptions(CLI::App& cli, Arguments& arguments) {
  auto& simulation = arguments.simulation;
  auto* session = cli.add_option("--session", arguments.file, "open a recorded session (.capstan)");
  cli.add_option("--table", arguments.file, "open a measured table or RAVEN-II motor log (.csv)")
      ->excludes(session);
  cli.add_option("--robot", arguments.robot,
                 "robot file (.yaml) for a simulation or a table; default: the left RAVEN-II");
  cli.add_flag("--simulate", arguments.simulate, "open a simulated robot, as the next options say");
  cli.add_option("--trajectory", simulation.trajectory,
                 "fls (block transfer), sinusoid, hold, hard-stop, or a CSV of t [s], q1, q2 [rad], q3 [m]")
      ->capture_default_str();
  cli.add_option("--truth", simulation.truth, "what the robot really is: default, matched, or a truth file")
      ->capture_default_str();
  cli.add_option("--seed", simulation.seed, "whole number: surgeon, noise and texture of the simulation")
      ->capture_default_str();
  cli.add_flag("--distractors", simulation.distractors, "objects of nearly the marker's colour");
  cli.add_flag("--uneven-light", simulation.uneven_light, "one side of the scene in the dark");
  cli.add_flag_callback(
      "--unregistered", [&simulation] { simulation.registered = false; },
      "leave the cameras' place to be found with the window");
  cli.add_option("--theme", arguments.theme, "dark or light; default: the one chosen last")
      ->check(CLI::IsMember({"dark", "light"}));
  cli.add_option("--size", arguments.size, "width x height of the window [px]")->capture_default_str();
  cli.add_option("--screenshot", arguments.picture,
                 "save a picture (.png) of the window, simulating unless a file is given, and quit");
  cli.add_option("--state", arguments.state, "of the window in the picture: running, occluded or paused")
      ->capture_default_str()
      ->check(CLI::IsMember({"running", "occluded", "paused"}));
  cli.add_option("--after", arguments.after, "time until the picture is taken [s]")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 3600.0));
}

int run(int argc, char** argv) {
  Arguments arguments;
  CLI::App cli("Capstan: the workstation's window", "capstan");
  cli.get_formatter()->column_width(34);
  addOptions(cli, arguments);
  CLI11_PARSE(cli, argc, argv);
  if (!std::getenv("DISPLAY")) {
    std::cerr << "capstan: no display (DISPLAY is not set). Use capstan-cli, or xvfb-run.\n";
    return 2;
  }
  QApplication application(argc, argv);
  int width = 1920, height = 1080;
  if (std::sscanf(arguments.size.c_str(), "%dx%d", &width, &height) != 2) {
    std::cerr << "capstan: --size = " << arguments.size << ": is not WxH. Write it as 1280x800.\n";
    return 2;
  }
  const bool picture = !arguments.picture.empty();
  capstan::widgets::MainWindow window(picture ? QString("/dev/null") : QString());
  if (!arguments.theme.empty()) window.setThemeNamed(QString::fromStdString(arguments.theme));
  auto choice = window.lastSource();
  if (arguments.simulate || picture) {
    arguments.simulation.robot = arguments.robot;
    choice = capstan::widgets::SourceChoice::ofSimulation(arguments.simulation);
  }
  if (!arguments.file.empty()) {
    choice = capstan::widgets::SourceChoice::ofFile(QString::fromStdString(arguments.file));
    choice.robot = QString::fromStdString(arguments.robot);
  }
  window.resize(width, height);
  window.show();
  window.open(choice);
  if (picture) planPicture(window, arguments);
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capstan: %s\n", error.what());
    return 2;
  }
}
