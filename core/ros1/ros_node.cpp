// C++17: see message_data.h.
#include "core/ros1/ros_node.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <unistd.h>

#include "core/ros1/master_topics.h"
#include "core/ros1/ros_topics.h"

namespace capstan::ros1 {
namespace {

constexpr int kThreads = 2;  // motors are not to wait for images
constexpr std::chrono::milliseconds kWatch = kRegister / 4;

/// ros::init() may be called once in a process.
void initialise() {
  static const bool once = [] {
    ros::VP_string none;
    ros::init(none, "capstan_" + std::to_string(getpid()), ros::init_options::NoSigintHandler);
    ros::master::setRetryTimeout(ros::WallDuration(0.2));
    return true;
  }();
  (void)once;
}

/// Without a master, roscpp would print an error for each of its requests. That no master answers is in the
/// state of the topics and in errors.
void sayOnlyWithMaster(bool master) {
  namespace console = ros::console;
  if (console::set_logger_level("ros.roscpp", master ? console::levels::Warn : console::levels::Fatal))
    console::notifyLoggerLevelsChanged();
}

}  // namespace

std::shared_ptr<RosNode> RosNode::get() {
  checkMasterUri();
  static std::mutex mutex;
  static std::weak_ptr<RosNode> node;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<RosNode> present = node.lock();
  if (!present) node = present = std::shared_ptr<RosNode>(new RosNode);
  return present;
}

RosNode::RosNode() {
  initialise();
  sayOnlyWithMaster(ros::master::check());
  if (!ros::isStarted()) ros::start();
  handle_ = std::make_unique<ros::NodeHandle>();
  spinner_ = std::make_unique<ros::AsyncSpinner>(kThreads);
  spinner_->start();
  watch_ = std::thread([this] { watch(); });
}

RosNode::~RosNode() {
  quit_ = true;
  watch_.join();
  spinner_->stop();
}

void RosNode::remember(const void* key, std::function<void()> again) {
  const std::lock_guard<std::mutex> lock(mutex_);
  again_[key] = std::move(again);
}

void RosNode::forget(const void* key) {
  const std::lock_guard<std::mutex> lock(mutex_);
  again_.erase(key);
}

bool RosNode::isKnown() const {
  XmlRpc::XmlRpcValue request, result, payload;
  request[0] = ros::this_node::getName();
  request[1] = ros::this_node::getName();
  return ros::master::execute("lookupNode", request, result, payload, false);
}

void RosNode::watch() {
  while (!quit_) {
    std::this_thread::sleep_for(kWatch);
    const bool master = ros::master::check();
    sayOnlyWithMaster(master);
    if (!master || isKnown()) continue;
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [key, again] : again_) again();
  }
}

}  // namespace capstan::ros1
