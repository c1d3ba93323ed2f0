#include "app/workstation/arguments.h"

#include <algorithm>
#include <cstdio>

#include "core/base/error.h"
#include "core/recording/recording_kinds.h"

namespace capstan::workstation {

namespace {

constexpr const char* kSimulation = "Simulation";

std::vector<CLI::Option*> simulationOptions(CLI::App& cli) {
  return cli.get_options([](const CLI::Option* option) { return option->get_group() == kSimulation; });
}

}  // namespace

void addOptions(CLI::App& cli, Arguments& arguments) {
  auto& simulation = arguments.simulation;
  const auto of = [&](CLI::Option* option) { return option->group(kSimulation); };
  auto* session = cli.add_option("--session", arguments.file, "open a recorded session (.capstan)");
  auto* table = cli.add_option("--table", arguments.file,
                               "open a " + recording::measuredTableKinds() + " or RAVEN-II motor log (.csv)")
                    ->excludes(session);
  auto* live = cli.add_option("--live", arguments.live,
                              "connect to a robot that sends its rows now: a live set-up file, "
                              "tcp://ADDRESS:PORT to listen on, or the path of a FIFO")
                   ->excludes(session)
                   ->excludes(table);
  cli.add_option("--robot", arguments.robot,
                 "robot file (.yaml) for a simulation, a table or a live robot; default: the left RAVEN-II");
  of(cli.add_flag("--simulate", arguments.simulate,
                  "open a simulated robot; implied by the other options of this group"));
  of(cli.add_option(
         "--trajectory", simulation.trajectory,
         "fls (block transfer), sinusoid, hold, hard-stop, or a CSV with t [s], q1, q2 [rad], q3 [m]"))
      ->capture_default_str();
  of(cli.add_option("--truth", simulation.truth,
                    "true parameters of the robot: default, matched, or a truth file"))
      ->capture_default_str();
  of(cli.add_option("--seed", simulation.seed,
                    "random seed (whole number) of the surgeon's motion, sensor noise and image texture"))
      ->capture_default_str();
  of(cli.add_flag("--distractors", simulation.distractors, "add objects of nearly the marker's colour"));
  of(cli.add_flag("--uneven-light", simulation.uneven_light, "light one side of the scene less"));
  of(cli.add_flag_callback(
      "--unregistered", [&simulation] { simulation.registered = false; },
      "unknown camera pose, to be registered in the window"));
  for (CLI::Option* option : simulationOptions(cli))
    option->excludes(session)->excludes(table)->excludes(live);
  cli.add_option(
      "--monitor-feed", arguments.monitor_feed,
      "name under which stereo monitors show the sessions from the start: capstan-monitor --feed NAME");
  cli.add_option(
         "--publish", arguments.publish,
         "ROS namespace to publish the estimates in, as in /capstan: measured_js, measured_cp, marker; "
         "or igtl://ADDRESS:PORT to listen on, for OpenIGTLink (3D Slicer): transforms TipToBase, "
         "CameraToBase; repeatable")
      ->allow_extra_args(false);
  cli.add_option("--theme", arguments.theme, "dark or light; default: the one chosen last")
      ->check(CLI::IsMember({"dark", "light"}));
  cli.add_option("--size", arguments.size, "width x height of the window [px]")->capture_default_str();
  auto* image =
      cli.add_option("--screenshot", arguments.image,
                     "save a picture (.png) of the window and quit; without a file it shows a simulation");
  cli.add_option("--state", arguments.state,
                 "state of the window in the picture: running, occluded or paused")
      ->capture_default_str()
      ->check(CLI::IsMember({"running", "occluded", "paused"}))
      ->needs(image);
  cli.add_option(
         "--show", arguments.show,
         "panel in the picture: health, calibration, filter, marker, register, analyse, diagnose or learn")
      ->check(CLI::IsMember(
          {"health", "calibration", "filter", "marker", "register", "analyse", "diagnose", "learn"}))
      ->needs(image);
  cli.add_option("--after", arguments.after, "time until the picture is saved [s]")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 3600.0))
      ->needs(image);
}

void imply(const CLI::App& cli, Arguments& arguments) {
  const auto asked =
      cli.get_options([](const CLI::Option* option) { return option->get_group() == kSimulation; });
  const bool any =
      std::any_of(asked.begin(), asked.end(), [](const CLI::Option* option) { return option->count() > 0; });
  const bool no_file = arguments.file.empty() && arguments.live.empty();
  arguments.simulate = no_file && (any || !arguments.robot.empty() || !arguments.image.empty());
}

widgets::SourceChoice choiceOf(const Arguments& arguments, const widgets::SourceChoice& last) {
  if (!arguments.live.empty()) {
    auto choice = widgets::SourceChoice::ofLive(QString::fromStdString(arguments.live));
    choice.robot = QString::fromStdString(arguments.robot);
    return choice;
  }
  if (!arguments.file.empty()) {
    auto choice = widgets::SourceChoice::ofFile(QString::fromStdString(arguments.file));
    choice.robot = QString::fromStdString(arguments.robot);
    return choice;
  }
  if (!arguments.simulate) return last;
  simulation::SimulationRequest request = arguments.simulation;
  request.robot = arguments.robot;
  return widgets::SourceChoice::ofSimulation(request);
}

QSize sizeOf(const std::string& text) {
  constexpr int kLeast = 200, kMost = 7680;
  const auto sane = [](int side) { return side >= kLeast && side <= kMost; };
  int width = 0, height = 0, used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || !sane(width) || !sane(height))
    throw base::InputError(
        {{}, 0, "--size", text, "is not WxH with sides of 200 to 7680 px", "Write it as 1280x800"});
  return {width, height};
}

}  // namespace capstan::workstation
