#include <CLI/CLI.hpp>
#include <QApplication>
#include <QScreen>
#include <QTimer>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>

#include "core/base/error.h"
#include "widgets/shell/main_window.h"

namespace {

struct Arguments {
  std::string file, robot, theme, picture, size = "1920x1080", state = "running";
  capstan::simulation::SimulationRequest simulation;
  bool simulate = false;
  double after = 12.0;
};

/// Width and height of --size. Throws base::InputError.
QSize sizeOf(const std::string& text) {
  constexpr int kLeast = 200, kMost = 7680;
  const auto sane = [](int side) { return side >= kLeast && side <= kMost; };
  int width = 0, height = 0, used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || !sane(width) || !sane(height))
    throw capstan::base::InputError(
        {{}, 0, "--size", text, "is not WxH with sides of 200 to 7680 px", "Write it as 1280x800"});
  return {width, height};
}

/// No larger than the screen leaves room for; a picture is as large as was asked.
void fitToScreen(QWidget& window, const QSize& size, bool picture) {
  const QScreen* screen = QGuiApplication::primaryScreen();
  window.resize(picture || !screen ? size : size.boundedTo(screen->availableGeometry().size()));
}

/// Nobody sees the window's message bar where only a picture was asked for.
void failWithoutSource(capstan::widgets::MainWindow& window) {
  QObject::connect(&window.link(), &capstan::widgets::SessionLink::failed, &window,
                   [&window](const QString& message) {
                     if (window.link().runner()) return;
                     std::cerr << "capstan: " << message.toStdString() << '\n';
                     QApplication::exit(2);
                   });
}

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
  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli.exit(error) == 0 ? 0 : 2;
  }
  const QSize size = sizeOf(arguments.size);
  if (!std::getenv("DISPLAY")) {
    std::cerr << "capstan: no display (DISPLAY is not set). Use capstan-cli, or xvfb-run.\n";
    return 2;
  }
  QApplication application(argc, argv);
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
  fitToScreen(window, size, picture);
  if (picture) failWithoutSource(window);
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
