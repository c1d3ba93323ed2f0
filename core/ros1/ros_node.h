#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

/// C++17: see message_data.h.
namespace capstan::ros1 {

/// The one node of this process. It begins with the first use and lives as long as somebody holds it.
class RosNode {
 public:
  static std::shared_ptr<RosNode> get();
  ~RosNode();

  ros::NodeHandle& handle() { return *handle_; }
  /// Calls `again` whenever the master has lost this node, until forget(key).
  void remember(const void* key, std::function<void()> again);
  void forget(const void* key);

 private:
  RosNode();
  void watch();
  bool isKnown() const;

  std::unique_ptr<ros::NodeHandle> handle_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::mutex mutex_;  ///< protects again_
  std::map<const void*, std::function<void()>> again_;
  std::atomic<bool> quit_{false};
  std::thread watch_;
};

}  // namespace capstan::ros1
