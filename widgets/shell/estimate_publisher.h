#pragma once

#include <QObject>
#include <string>

#include "core/live/estimate_topics.h"

namespace capstan::widgets {

class SessionLink;

/// Publishes the estimates of every session of the window on ROS topics (live::EstimateTopics).
class EstimatePublisher : public QObject {
 public:
  /// Throws base::InputError (live::EstimateTopics).
  EstimatePublisher(SessionLink& link, const std::string& name_space, QObject* parent);

 private:
  live::EstimateTopics topics_;
};

}  // namespace capstan::widgets
