#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/live/live_setup.h"
#include "core/live/live_source.h"

namespace capstan::live {

/// What comes from a robot at this moment, before a session is begun with it.
struct LivePreviewState {
  std::vector<std::string> faults;  ///< why a side cannot be connected to; empty: both are, or not yet
  std::vector<tracking::SideStatus> sides;  ///< empty: not connected yet
  std::optional<Eigen::Vector3d> motors;    ///< newest positions in the order of the joints [rad]
  Eigen::Vector3d joints{0.0, 0.0, 0.0};    ///< transmission kinematics of `motors` [rad or m]
  std::array<bool, 3> prismatic{};          ///< joints that are linear
  std::array<bool, 3> moving{};             ///< motors that have moved within the last second
  cv::Mat left, right;                      ///< newest images, 8-bit BGR; empty: none
};

/// Connects to a robot on a thread of its own and shows what comes, without tracking. Images come also while
/// the motors are silent.
class LivePreview {
 public:
  explicit LivePreview(LiveSetup setup);
  /// Ends the connection: its ports and devices are free afterwards.
  ~LivePreview();

  LivePreviewState state() const;

  static constexpr double kMoving = 0.01;  ///< a motor that moves more than this in half a second moves [rad]

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kFrames = 4;

  /// Range of the motors' positions in the present half second and the one before.
  struct Ranges {
    Clock::time_point begin;
    Eigen::Array3d low, high, before = Eigen::Array3d::Zero();
    void add(const Eigen::Vector3d& position, Clock::time_point now);
  };

  void work();
  /// Calls `work`; a base::InputError becomes a fault of the state.
  template <class Work>
  void notingFaults(Work&& work);
  void take(const tracking::Sample& sample);

  const LiveSetup setup_;
  std::atomic<bool> quit_{false};
  SampleQueue frames_{kFrames, kFrames};

  mutable std::mutex mutex_;  ///< protects the members below
  std::unique_ptr<LiveSource> motors_;
  std::unique_ptr<CameraSide> cameras_;
  std::optional<robot::Transmission> transmission_;  ///< of the robot of motors_
  LivePreviewState state_;
  std::optional<Ranges> ranges_;

  std::thread thread_;
};

}  // namespace capstan::live
