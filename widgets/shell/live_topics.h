#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/ros1/message_data.h"
#include "widgets/jobs/job.h"

class QComboBox;
class QLabel;

namespace capstan::widgets {

/// Adds the topics of a running ROS 1 system to the lists of addresses of the live dialog: motors to one,
/// images to the others. Asks the master in the background, again and again while it is on.
class LiveTopics : public QObject {
  Q_OBJECT

 public:
  LiveTopics(QComboBox* motors, std::vector<QComboBox*> images, QObject* parent);

  /// Says which master answers, or that none does.
  QLabel* label() const { return label_; }
  /// Begins or ends to ask.
  void setOn(bool on);
  /// Adds the topics that are known, to lists that were filled again.
  void refill();

 private:
  using Topics = std::optional<std::vector<ros1::TopicType>>;

  void ask();
  void show(const std::string& master, Topics topics);

  QComboBox* motors_;
  std::vector<QComboBox*> images_;
  QLabel* label_;
  std::vector<ros1::TopicType> topics_;
  QTimer timer_;
  Job job_;
};

}  // namespace capstan::widgets
