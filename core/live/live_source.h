#pragma once

#include <memory>
#include <optional>

#include "core/live/camera_side.h"
#include "core/live/joint_commander.h"
#include "core/live/latency_meter.h"
#include "core/live/live_setup.h"
#include "core/live/row_side.h"
#include "core/live/sample_queue.h"
#include "core/robot/transmission.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// A robot that sends its samples while they are measured. Its thread receives; next() waits.
class LiveSource final : public tracking::Source, public Commandable {
 public:
  /// Opens the set-up's addresses. The source ends `duration` [s] after its first sample, by the session's
  /// clock; where no more samples come, by that of this computer, kLate later. Where none ever comes:
  /// kLateBegin after that time from now. 0: it does not end by itself. From standard input the first rows
  /// are awaited, and a fault in the rows ends the source; elsewhere it disconnects the program that has sent
  /// it, and another one may connect. Throws base::InputError for an address that cannot be opened, and for
  /// the first rows of standard input.
  explicit LiveSource(const LiveSetup& setup, double duration = 0.0);
  /// For a look at what comes: motors that put a joint outside its limits are shown, with a warning.
  static std::unique_ptr<LiveSource> forPreview(const LiveSetup& setup);
  ~LiveSource() override;

  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override;
  bool ready(std::chrono::milliseconds wait) override;
  void discard() override;
  void block(bool left, bool right) override { left_blocked_ = left, right_blocked_ = right; }
  std::vector<tracking::SideStatus> sides() const override;
  /// Commands to the robot; null: the set-up has none. It gets the position of every motor sample that is
  /// tracked. The session's end stops it.
  std::shared_ptr<RobotCommands> commands() const override { return commander_; }

 private:
  LiveSource(const LiveSetup& setup, double duration, RowSide::Faults faults);
  void readCameras(const CamerasSetup& setup);
  void noteTracked();
  bool timeIsUp() const;

  tracking::SourceInfo info_;
  std::optional<MotorArrangement> arrangement_;
  SampleQueue queue_;
  struct Taken {
    SampleQueue::Clock::time_point offered;
    bool camera = false;
  };
  std::optional<Taken> taken_;  ///< by tracking, whose estimate is not known to exist yet
  LatencyMeter motor_latency_, camera_latency_;
  std::unique_ptr<RowSide> rows_;
  std::unique_ptr<CameraSide> cameras_;  ///< null: none; ends before rows_, whose clock it uses
  std::shared_ptr<JointCommander> commander_;
  std::optional<robot::Transmission> transmission_;  ///< of the robot that is commanded
  const double duration_;                            ///< [s]; 0: unlimited
  std::optional<double> begin_;                      ///< session time of the first sample [s]
  SampleQueue::Clock::time_point begun_at_ =
      SampleQueue::Clock::now();  ///< when it came; before, of this object
  bool left_blocked_ = false, right_blocked_ = false;
};
inline constexpr std::chrono::seconds kLate{2}, kLateBegin{10};

}  // namespace capstan::live
