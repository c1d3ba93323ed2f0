// C++17: see message_data.h.
#include "core/ros1/ros_topics.h"

#include <ros/master.h>
#include <ros/names.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>

#include "core/base/error.h"
#include "core/ros1/raw_message.h"
#include "core/ros1/ros_node.h"

namespace capstan::ros1 {
namespace {

using Event = ros::MessageEvent<RawMessage const>;

void checkTopic(const std::string& topic) {
  std::string reason;
  if (topic.empty() || topic[0] != '/' || !ros::names::validate(topic, reason))
    throw base::InputError({{},
                            0,
                            "topic",
                            topic,
                            "is no name of a ROS topic",
                            "Begin it with / and use letters, digits, _ and /"});
}

std::string entryOf(const ros::M_string& header, const char* key) {
  const auto found = header.find(key);
  return found == header.end() ? std::string() : found->second;
}

}  // namespace

class TopicReader::Impl : public std::enable_shared_from_this<TopicReader::Impl> {
 public:
  Impl(std::string topic, std::size_t capacity) : topic_(std::move(topic)), capacity_(capacity) {}

  void begin() {
    subscribe();
    node_->remember(this, [this] { subscribe(); });
  }
  void end() {
    node_->forget(this);
    const std::lock_guard<std::mutex> lock(subscribing_);
    subscriber_.shutdown();
  }

  std::optional<TopicMessage> next(std::chrono::milliseconds wait) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!come_.wait_for(lock, wait, [&] { return !messages_.empty(); })) return std::nullopt;
    TopicMessage message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }
  std::uint64_t lost() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return lost_;
  }
  std::uint64_t connections() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return connections_;
  }
  bool hasPublisher() const {
    const std::lock_guard<std::mutex> lock(subscribing_);
    return subscriber_.getNumPublishers() > 0;
  }

 private:
  void subscribe() {
    const std::lock_guard<std::mutex> lock(subscribing_);
    subscriber_.shutdown();
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const Event&>(topic_, static_cast<std::uint32_t>(capacity_),
                                                 [weak = weak_from_this()](const Event& event) {
                                                   if (const auto self = weak.lock()) self->take(event);
                                                 });
    options.md5sum = "*", options.datatype = "*";
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    subscriber_ = node_->handle().subscribe(options);
  }

  void take(const Event& event) {
    const auto arrival = std::chrono::steady_clock::now();
    const ros::M_string& header = event.getConnectionHeader();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (const std::string from = event.getPublisherName(); from != publisher_)
      publisher_ = from, ++connections_;
    messages_.push_back({arrival, entryOf(header, "type"), entryOf(header, "message_definition"),
                         event.getConstMessage()->bytes, 0});
    if (messages_.size() > capacity_) {
      const std::uint64_t lost = messages_.front().lost + 1;
      messages_.pop_front();
      messages_.front().lost += lost;
      ++lost_;
    }
    come_.notify_one();
  }

  const std::string topic_;
  const std::size_t capacity_;
  const std::shared_ptr<RosNode> node_ = RosNode::get();
  mutable std::mutex subscribing_;  ///< protects subscriber_
  ros::Subscriber subscriber_;
  mutable std::mutex mutex_;  ///< protects the members below
  std::condition_variable come_;
  std::deque<TopicMessage> messages_;
  std::string publisher_;
  std::uint64_t lost_ = 0, connections_ = 0;
};

TopicReader::TopicReader(const std::string& topic, std::size_t capacity) {
  checkTopic(topic);
  impl_ = std::make_shared<Impl>(topic, capacity);
  impl_->begin();
}
TopicReader::~TopicReader() { impl_->end(); }
std::optional<TopicMessage> TopicReader::next(std::chrono::milliseconds wait) { return impl_->next(wait); }
std::uint64_t TopicReader::lost() const { return impl_->lost(); }
std::uint64_t TopicReader::connections() const { return impl_->connections(); }
bool TopicReader::hasPublisher() const { return impl_->hasPublisher(); }

class TopicWriter::Impl {
 public:
  Impl(std::string topic, MessageType type, bool latched)
      : topic_(std::move(topic)), type_(std::move(type)), latched_(latched) {
    advertise();
    node_->remember(this, [this] { advertise(); });
  }
  ~Impl() {
    node_->forget(this);
    publisher_.shutdown();
  }

  void publish(const Bytes& bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (latched_) last_ = bytes;
    publisher_.publish(RawMessage{type_, bytes});
  }
  std::uint32_t subscribers() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return publisher_.getNumSubscribers();
  }

 private:
  void advertise() {
    constexpr std::uint32_t kQueue = 1000;
    const std::lock_guard<std::mutex> lock(mutex_);
    publisher_.shutdown();
    ros::AdvertiseOptions options(topic_, kQueue, type_.md5, type_.name, type_.definition);
    options.latch = latched_;
    publisher_ = node_->handle().advertise(options);
    if (!last_.empty()) publisher_.publish(RawMessage{type_, last_});
  }

  const std::string topic_;
  const MessageType type_;
  const bool latched_;
  const std::shared_ptr<RosNode> node_ = RosNode::get();
  mutable std::mutex mutex_;  ///< protects the members below
  ros::Publisher publisher_;
  Bytes last_;
};

TopicWriter::TopicWriter(const std::string& topic, const MessageType& type, bool latched) {
  checkTopic(topic);
  impl_ = std::make_unique<Impl>(topic, type, latched);
}
TopicWriter::~TopicWriter() = default;
void TopicWriter::publish(const Bytes& bytes) { impl_->publish(bytes); }
std::uint32_t TopicWriter::subscribers() const { return impl_->subscribers(); }

bool isMasterThere() {
  const std::shared_ptr<RosNode> node = RosNode::get();
  return ros::master::check();
}

std::string masterAddress() {
  const std::shared_ptr<RosNode> node = RosNode::get();
  return ros::master::getURI();
}

std::int64_t rosTimeNow() {
  const ros::WallTime now = ros::WallTime::now();
  return static_cast<std::int64_t>(now.sec) * 1000000000 + now.nsec;
}

}  // namespace capstan::ros1
