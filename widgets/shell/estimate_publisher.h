#pragma once

#include <QObject>
#include <string>
#include <vector>

#include "core/live/estimate_output.h"

namespace capstan::widgets {

class SessionLink;

/// Publishes the estimates of every session of the window (live::EstimateOutputs).
class EstimatePublisher : public QObject {
 public:
  /// `to`: ROS namespaces and OpenIGTLink addresses. Throws base::InputError (live::EstimateOutputs).
  EstimatePublisher(SessionLink& link, const std::vector<std::string>& to, QObject* parent);

 private:
  live::EstimateOutputs outputs_;
};

}  // namespace capstan::widgets
