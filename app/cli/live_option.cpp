#include "app/cli/live_option.h"

#include <chrono>

#include "app/cli/console.h"
#include "core/tracking/side_text.h"
#include "core/tracking/side_watch.h"

namespace capstan::cli {

CLI::Option* addLive(CLI::App& command, std::string& live) {
  return command.add_option(
      "--live", live,
      "robot that sends its rows now: a live set-up file (resources/live), tcp://ADDRESS:PORT to listen on,\n"
      "the path of a FIFO, or - for standard input; rows are those of a measured table");
}

void addMonitorFeed(CLI::App& command, std::string& name) {
  command.add_option("--monitor-feed", name,
                     "name under which stereo monitors show the session: capstan-monitor --feed NAME");
}

std::unique_ptr<live::MonitorFeed> makeMonitorFeed(const std::string& name) {
  return name.empty() ? nullptr : std::make_unique<live::MonitorFeed>(name);
}

void addPublish(CLI::App& command, std::vector<std::string>& to) {
  command
      .add_option("--publish", to,
                  "ROS namespace to publish the estimates in, as in /capstan: measured_js, measured_cp,\n"
                  "measured_cp_covariance, marker; or igtl://ADDRESS:PORT to listen on, for OpenIGTLink (3D\n"
                  "Slicer): transforms TipToBase, CameraToBase; repeatable")
      ->allow_extra_args(false);
}

std::unique_ptr<live::EstimateOutputs> makeEstimateOutputs(const std::vector<std::string>& to) {
  if (to.empty()) return nullptr;
  auto outputs = std::make_unique<live::EstimateOutputs>(to, "--publish");
  for (const std::string& address : outputs->addresses()) notice("transforms go to " + address);
  return outputs;
}

std::unique_ptr<live::LiveSource> openLive(const std::string& text, const std::string& robot,
                                           const std::string& read_as, double duration) {
  auto source = std::make_unique<live::LiveSource>(live::liveSetupOf(text, robot, read_as), duration);
  for (const std::string& line : source->info().notices) notice(line);
  if (text != "-") notice("waiting for rows from " + source->sides().front().from);
  return source;
}

std::string unregisteredText(const tracking::SourceInfo& info) {
  if (!info.rig || info.base_from_camera) return {};
  return "the live set-up names no registration: the filter runs on kinematics. Register in the window "
         "(capstan --live, Ctrl+R), and write the file into the set-up, as `registration:` of `cameras:`";
}

std::string nothingCameText(const std::vector<tracking::SideStatus>& sides) {
  const bool refused = !sides.empty() && sides.front().refused > 0;
  return refused ? "no row was accepted: nothing was tracked" : "no row came: nothing was tracked";
}

SideNotices::SideNotices(std::function<std::vector<tracking::SideStatus>()> sides)
    : thread_([sides = std::move(sides)](const std::stop_token& stop) {
        constexpr std::chrono::milliseconds kPeriod{50};
        tracking::SideWatch watch;
        while (!stop.stop_requested()) {
          for (const std::string& sentence : watch.observe(sides())) notice(sentence);
          std::this_thread::sleep_for(kPeriod);
        }
      }) {}

std::string textOf(const std::vector<tracking::SideStatus>& sides) {
  std::string text;
  for (const tracking::SideStatus& side : sides) text += tracking::textOf(side) + '\n';
  return text;
}

/// `text`, or null where it is empty.
nlohmann::json orNull(const std::string& text) {
  return text.empty() ? nlohmann::json() : nlohmann::json(text);
}

nlohmann::json jsonOf(const std::vector<tracking::SideStatus>& sides) {
  nlohmann::json all = nlohmann::json::array();
  for (const tracking::SideStatus& side : sides) {
    nlohmann::json clock, latency, times;
    if (side.latency) latency = {{"median", side.latency->median}, {"p99", side.latency->p99}};
    if (side.clock)
      clock = {{"steps", side.clock->steps},          {"last_step", side.clock->last_step},
               {"offset", side.clock->offset},        {"offset_sigma", side.clock->offset_sigma},
               {"drift", side.clock->drift},          {"drift_sigma", side.clock->drift_sigma},
               {"mean_delay", side.clock->mean_delay}};
    if (side.times) times = base::nameOf(*side.times);
    all.push_back({{"side", side.name},
                   {"from", side.from},
                   {"state", base::nameOf(side.state)},
                   {"fault", orNull(side.fault)},
                   {"reason", orNull(side.reason)},
                   {"received", side.received},
                   {"missing", side.missing},
                   {"repeated", side.repeated},
                   {"dropped", side.dropped},
                   {"gaps", side.gaps},
                   {"incomplete", side.incomplete},
                   {"unmatched", side.encoders.unmatched},
                   {"late_encoders", side.encoders.late},
                   {"undated", side.undated},
                   {"unpaired", side.unpaired},
                   {"frozen", side.frozen},
                   {"connections", side.connections},
                   {"refused", side.refused},
                   {"notices", side.notices},
                   {"times", std::move(times)},
                   {"latency", std::move(latency)},
                   {"clock", std::move(clock)}});
  }
  return all;
}

}  // namespace capstan::cli
