#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "core/live/estimate_output.h"
#include "core/live/live_source.h"
#include "core/live/monitor_feed.h"

namespace capstan::cli {

/// Declares --live on `command`.
CLI::Option* addLive(CLI::App& command, std::string& live);
/// Declares --monitor-feed on `command`.
void addMonitorFeed(CLI::App& command, std::string& name);
/// Feed of that name; null: `name` is empty. Throws base::InputError (live::MonitorFeed).
std::unique_ptr<live::MonitorFeed> makeMonitorFeed(const std::string& name);
/// Declares --publish on `command`.
void addPublish(CLI::App& command, std::vector<std::string>& to);
/// Outputs that --publish names, and says where they listen; null: none. Throws base::InputError
/// (live::EstimateOutputs).
std::unique_ptr<live::EstimateOutputs> makeEstimateOutputs(const std::vector<std::string>& to);
/// Opens the robot that --live names and says where it listens. The source ends `duration` [s] after its
/// first sample; 0: never (live::LiveSource). Throws base::InputError as live::liveSetupOf() and
/// live::LiveSource.
std::unique_ptr<live::LiveSource> openLive(const std::string& text, const std::string& robot,
                                           const std::string& read_as, double duration);
/// Sentence for a live source with cameras that are not registered, and what to do; empty: there is no need.
std::string unregisteredText(const tracking::SourceInfo& info);
/// Sentence for a live source that has ended without a row. `sides` are of its end.
std::string nothingCameText(const std::vector<tracking::SideStatus>& sides);
/// Prints a notice whenever a side of a live source falls silent, comes back, or its clock steps, for the
/// lifetime of the object.
class SideNotices {
 public:
  /// `sides` is called on a thread of this object.
  explicit SideNotices(std::function<std::vector<tracking::SideStatus>()> sides);

 private:
  std::jthread thread_;
};

/// Lines for people about the sides of a live source.
std::string textOf(const std::vector<tracking::SideStatus>& sides);
/// JSON of the sides in SI.
nlohmann::json jsonOf(const std::vector<tracking::SideStatus>& sides);

}  // namespace capstan::cli
