#include "core/live/live_preview.h"

#include "core/base/error.h"

namespace capstan::live {

LivePreview::LivePreview(LiveSetup setup) : setup_(std::move(setup)), thread_([this] { work(); }) {}

LivePreview::~LivePreview() {
  quit_ = true;
  thread_.join();
}

LivePreviewState LivePreview::state() const {
  const std::lock_guard lock(mutex_);
  LivePreviewState state = state_;
  if (motors_) state.sides = motors_->sides();
  if (cameras_) state.sides.push_back(cameras_->status());
  if (ranges_ && Clock::now() - ranges_->begin < std::chrono::seconds(1))
    for (Eigen::Index k = 0; k < 3; ++k)
      state.moving[static_cast<std::size_t>(k)] =
          std::max(ranges_->before(k), ranges_->high(k) - ranges_->low(k)) > kMoving;
  return state;
}

template <class Work>
void LivePreview::notingFaults(Work&& work) {
  try {
    work();
  } catch (const base::InputError& error) {
    const std::lock_guard lock(mutex_);
    state_.faults.emplace_back(error.what());
  }
}

void LivePreview::work() {
  notingFaults([&] {
    checkMotors(setup_.motors);
    LiveSetup without = setup_;
    without.cameras.reset(), without.commands.reset();
    std::unique_ptr<LiveSource> motors = LiveSource::forPreview(without);
    const std::lock_guard lock(mutex_);
    motors_ = std::move(motors);
    const robot::Description& robot = motors_->info().robot;
    transmission_.emplace(robot);
    for (std::size_t k = 0; k < 3; ++k)
      state_.prismatic[k] = robot.joints[k].type == robot::JointType::kPrismatic;
  });
  if (setup_.cameras)
    notingFaults([&] {
      const auto since = [begin = Clock::now()](Clock::time_point at) -> std::optional<double> {
        return std::chrono::duration<double>(at - begin).count();
      };
      auto cameras =
          std::make_unique<CameraSide>(*setup_.cameras, CameraSide::SessionClock{since, {}, {}, {}}, frames_);
      const std::lock_guard lock(mutex_);
      cameras_ = std::move(cameras);
    });
  bool receiving = motors_ != nullptr;  // from the motors, until they end
  tracking::Sample sample;
  constexpr std::chrono::milliseconds kWait{20}, kNone{0};
  while (!quit_) {
    if (receiving && motors_->ready(kWait)) {
      receiving = false;
      notingFaults([&] { receiving = motors_->next(sample); });
      if (receiving) take(sample);
    }
    while (!quit_ && frames_.ready(receiving ? kNone : kWait) && frames_.take(sample)) take(sample);
  }
  std::unique_ptr<LiveSource> motors;  // closed without the lock, since their threads may take a second
  std::unique_ptr<CameraSide> cameras;
  const std::lock_guard lock(mutex_);
  motors = std::move(motors_), cameras = std::move(cameras_);
}

void LivePreview::take(const tracking::Sample& sample) {
  const Clock::time_point now = Clock::now();
  if (const auto* motors = std::get_if<tracking::MotorSample>(&sample)) {
    const std::lock_guard lock(mutex_);
    state_.motors = motors->position;
    state_.joints = transmission_->jointFromMotor(motors->position);
    if (!ranges_) ranges_ = Ranges{now, motors->position.array(), motors->position.array()};
    ranges_->add(motors->position, now);
  } else if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) {
    cv::Mat left = frame->left.clone(), right = frame->right.clone();
    const std::lock_guard lock(mutex_);
    state_.left = left, state_.right = right;
  }
}

void LivePreview::Ranges::add(const Eigen::Vector3d& position, Clock::time_point now) {
  constexpr std::chrono::milliseconds kWindow{500};
  if (now - begin >= kWindow) {
    before = high - low;
    begin = now, low = high = position.array();
  }
  low = low.min(position.array()), high = high.max(position.array());
}

}  // namespace capstan::live
