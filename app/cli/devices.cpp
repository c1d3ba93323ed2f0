#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/live/cameras/video_devices.h"

namespace capstan::cli {
namespace {

std::string wordsOf(const live::VideoDevice& device) {
  if (!device.fault.empty()) return fmt::format("{}  cannot be used: {}\n", device.path, device.fault);
  std::string text = fmt::format("{}  {}, {}\n", device.path, device.name, device.at);
  for (const live::VideoFormat& format : device.formats)
    text += fmt::format("  {:<5}{:>5} × {:<5}{:g} frames/s\n", format.pixels, format.width, format.height,
                        fmt::join(format.rates, ", "));
  for (const live::VideoControl& control : device.controls)
    text += fmt::format("  {}: {} to {}, now {}\n", control.name, control.least, control.most, control.now);
  return text;
}

nlohmann::json documentOf(const live::VideoDevice& device) {
  nlohmann::json formats = nlohmann::json::array(), controls = nlohmann::json::array();
  for (const live::VideoFormat& format : device.formats)
    formats.push_back({{"pixels", format.pixels},
                       {"width", format.width},
                       {"height", format.height},
                       {"rates", format.rates}});
  for (const live::VideoControl& control : device.controls)
    controls.push_back(
        {{"name", control.name}, {"least", control.least}, {"most", control.most}, {"now", control.now}});
  return {{"path", device.path},
          {"name", device.name},
          {"at", device.at},
          {"fault", device.fault.empty() ? nlohmann::json() : nlohmann::json(device.fault)},
          {"formats", std::move(formats)},
          {"controls", std::move(controls)}};
}

ExitCode devices(const std::string& json) {
  checkOutputs({{"--json", json}}, {});
  const Output output(json);
  const std::vector<live::VideoDevice> cameras = live::listVideoDevices();
  nlohmann::json all = nlohmann::json::array();
  for (const live::VideoDevice& camera : cameras) {
    output.text(wordsOf(camera));
    all.push_back(documentOf(camera));
  }
  if (cameras.empty())
    output.text("no cameras: nothing in /dev/video*. Is one plugged in, and has this user its permission?\n");
  output.json({{"cameras", std::move(all)}});
  return kOk;
}

}  // namespace

void addDevices(CLI::App& app, ExitCode& exit) {
  auto json = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("devices", "List the cameras of this computer, for a live set-up file");
  command->add_option("--json", *json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Example:\n"
      "  capstan-cli devices");
  command->callback([json, &exit] { exit = devices(*json); });
}

}  // namespace capstan::cli
