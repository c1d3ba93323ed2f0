#include "core/analysis/rerun.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/robot/description.h"
#include "core/tracking/arrival.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::analysis {

bool RerunChange::empty() const { return words().empty(); }

std::string RerunChange::words() const {
  std::vector<std::string> parts;
  if (!robot.empty()) parts.push_back("robot " + robot.filename().string());
  if (!options.empty()) parts.push_back("options " + options.filename().string());
  if (filter) parts.push_back(fmt::format("filter {}", base::nameOf(*filter)));
  if (one_camera) parts.push_back(fmt::format("one camera {}", base::nameOf(*one_camera)));
  if (gate_probability) parts.push_back(fmt::format("gate {:g}", *gate_probability));
  if (camera_delay) parts.push_back(fmt::format("camera delay {:g} ms", 1e3 * *camera_delay));
  return fmt::format("{}", fmt::join(parts, ", "));
}

RerunSetup rerunSetup(const tracking::SourceInfo& info, const RerunChange& change) {
  RerunSetup setup{info, {}};
  if (!change.robot.empty()) setup.info.robot = robot::readDescriptionOrDefault(change.robot);
  setup.options = change.options.empty() ? tracking::trackingOptionsOf(info)
                                         : tracking::readTrackingOptions(change.options);
  if (change.filter) setup.options.filter = *change.filter;
  if (change.one_camera) setup.options.one_camera = *change.one_camera;
  if (change.gate_probability) setup.options.gate_probability = *change.gate_probability;
  if (change.camera_delay) setup.options.camera_delay = *change.camera_delay;
  return setup;
}

tracking::TrackReport rerun(tracking::Source& source, const tracking::SourceInfo& info,
                            const RerunChange& change, base::Progress& progress,
                            const std::function<void(const tracking::Snapshot&)>& each, double until) {
  struct Part {
    tracking::Source& source;
    double until;
    bool next(tracking::Sample& sample) {
      return source.next(sample) && tracking::arrivalOf(sample) <= until;
    }
  };
  const RerunSetup setup = rerunSetup(info, change);
  tracking::TrackingPipeline pipeline = tracking::makePipeline(setup.info, setup.options);
  Part part{source, until};
  const double duration = std::min(setup.info.duration, until - setup.info.begin);
  return tracking::trackAll(
      part, pipeline, &progress, duration,
      [&each](const tracking::Sample&, const tracking::Snapshot& snapshot) { each(snapshot); });
}

}  // namespace capstan::analysis
