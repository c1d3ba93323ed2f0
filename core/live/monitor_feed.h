#pragma once

#include <memory>
#include <string>

#include "core/live/feed/feed_writer.h"
#include "core/live/runner.h"

namespace capstan::live {

/// Feeds stereo monitors from sessions, one after another: a listener that publishes every pair of images
/// with what the filter estimated for its time of exposure, at most every kImagePeriod of the wall clock, and
/// the state alone while there are no images. On the pipeline's thread it costs one copy of the images; motor
/// samples cost one copy of the estimate.
class MonitorFeed {
 public:
  /// Throws base::InputError (FeedWriter).
  explicit MonitorFeed(const std::string& name);
  ~MonitorFeed();
  MonitorFeed(const MonitorFeed&) = delete;
  MonitorFeed& operator=(const MonitorFeed&) = delete;

  const std::string& name() const;

  /// Begins a session with these facts. The listener belongs to its runner (Runner::listen). Listeners of
  /// former sessions publish nothing from now on.
  Listener begin(const tracking::SourceInfo& info);
  /// Any thread.
  void setState(RunState state);

 private:
  class Session;
  class Shared;
  std::shared_ptr<Shared> shared_;
};

/// A feed under the first name that no running session uses: kFeedName, kFeedName-2, … Throws
/// base::InputError.
std::unique_ptr<MonitorFeed> makeMonitorFeed();

}  // namespace capstan::live
