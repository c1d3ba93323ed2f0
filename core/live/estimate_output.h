#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/live/runner.h"

namespace capstan::live {

/// Other programs that get the estimates of sessions while they run.
class EstimateOutput {
 public:
  virtual ~EstimateOutput() = default;
  /// Listener for a session with these facts.
  virtual Listener begin(const tracking::SourceInfo& info) = 0;
  /// Where programs can connect to; empty where they find it by themselves.
  virtual std::string address() const { return {}; }
};

/// Several outputs as one.
class EstimateOutputs final : public EstimateOutput {
 public:
  /// Each of `texts` is a ROS namespace, as "/capstan" (EstimateTopics), or "igtl://ADDRESS:PORT"
  /// (TipTransforms). Throws base::InputError that names `option` for another text, for a port that cannot be
  /// listened on, and where this program was built without ROS.
  EstimateOutputs(const std::vector<std::string>& texts, const std::string& option);

  Listener begin(const tracking::SourceInfo& info) override;
  /// Addresses of those that have one.
  std::vector<std::string> addresses() const;

 private:
  std::vector<std::unique_ptr<EstimateOutput>> outputs_;
};

}  // namespace capstan::live
