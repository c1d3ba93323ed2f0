#include "core/live/camera_side.h"

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/error.h"
#include "core/live/streams/address.h"
#include "core/live/topic_hint.h"
#include "core/ros1/bag_topics.h"
#include "core/ros1/received_image.h"
#include "core/ros1/ros_topics.h"
#include "core/ros1/stamp.h"

namespace capstan::live {
namespace {

using State = tracking::SideStatus::State;
constexpr std::size_t kWaiting = 16;  // images of a topic that may wait: 0.5 s of 30 images/s

/// Left and right half, or upper and lower half, of one image, copied.
std::array<cv::Mat, 2> eyesOf(const cv::Mat& both, CameraLayout layout) {
  if (layout == CameraLayout::kSideBySide) {
    const int half = both.cols / 2;
    return {both.colRange(0, half).clone(), both.colRange(half, 2 * half).clone()};
  }
  const int half = both.rows / 2;
  return {both.rowRange(0, half).clone(), both.rowRange(half, 2 * half).clone()};
}

VideoSettings settingsOf(const CamerasSetup& setup) {
  return {setup.width, setup.height,        setup.rate, setup.exposure,
          setup.gain,  setup.white_balance, setup.focus};
}

}  // namespace

CameraSide::CameraSide(const CamerasSetup& setup, SessionClock clock, SampleQueue& queue)
    : setup_(setup),
      addresses_(setup.layout == CameraLayout::kTwo ? std::vector{setup.left, setup.right}
                                                    : std::vector{setup.left}),
      session_(std::move(clock)),
      queue_(queue),
      pairer_(setup.pairing) {
  newest_.fill({start_, start_});
  status_.name = "cameras";
  status_.counted = "image";
  for (const std::string& address : addresses_) {
    status_.from += (status_.from.empty() ? "" : ", ") + address;
    const bool later = isNetworkStream(address) || isRosTopic(address);
    first_.push_back(later ? nullptr : std::make_unique<VideoStream>(address, settingsOf(setup)));
  }
  files_ = std::ranges::all_of(first_, [](const auto& video) { return video && video->isFile(); });
  for (int stream = 0; stream < static_cast<int>(addresses_.size()); ++stream)
    threads_.emplace_back([this, stream] { work(stream); });
}

CameraSide::~CameraSide() {
  quit_ = true;
  for (std::thread& thread : threads_) thread.join();
}

tracking::SideStatus CameraSide::status() const {
  const std::lock_guard lock(mutex_);
  tracking::SideStatus status = status_;
  if (status.state == State::kReceiving) judge(status);
  status.unpaired = pairer_.unpaired(), status.frozen = pairer_.frozen();
  status.dropped += pairer_.dropped();
  return status;
}

void CameraSide::judge(tracking::SideStatus& status) const {
  const Clock::time_point now = Clock::now();
  const auto since = [&](Clock::time_point t) { return std::chrono::duration<double>(now - t).count(); };
  const auto all = std::span(newest_).first(addresses_.size());
  const auto find = [&](State state, Clock::time_point Newest::*time) {
    const auto longest = std::ranges::min_element(all, {}, time),
               shortest = std::ranges::max_element(all, {}, time);
    status.silent_for = since(*longest.*time);
    if (status.silent_for <= tracking::SideStatus::kSilence) return false;
    status.state = state;
    if (since(*shortest.*time) <= tracking::SideStatus::kSilence)
      status.part = longest == all.begin() ? "left" : "right";
    return true;
  };
  if (!find(State::kSilent, &Newest::image)) find(State::kFrozen, &Newest::change);
}

void CameraSide::work(int stream) {
  const std::string& address = addresses_[static_cast<std::size_t>(stream)];
  if (isRosTopic(address)) return workOnTopic(stream, rosTopicOf(address));
  std::unique_ptr<VideoStream> video = std::move(first_[static_cast<std::size_t>(stream)]);
  while (!quit_) {
    try {
      if (!video) video = std::make_unique<VideoStream>(address, settingsOf(setup_));
      readStream(stream, *video);
    } catch (const std::exception& error) {
      const std::lock_guard lock(mutex_);
      status_.fault = error.what();
    }
    if (video && video->isFile()) return;  // it has been played
    video.reset();
    waitToReopen();
  }
}

void CameraSide::waitToReopen() const {
  constexpr int kTenths = 5;
  for (int k = 0; k < kTenths && !quit_; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

void CameraSide::waitForSession() const {
  constexpr std::chrono::milliseconds kPeriod{1};
  while (!quit_ && !session_.at(Clock::now())) std::this_thread::sleep_for(kPeriod);
}

/// Waits until the session's clock has the time of an image of a file, and a motor sample that of its
/// exposure: the filter cannot use an image that is ahead of the motors. Silent motors hold it up by kSilent.
CameraSide::Times CameraSide::waitUntilDue(double position) const {
  constexpr std::chrono::milliseconds kPeriod{2};
  constexpr double kSilent = 0.25;  // [s]
  const double due = (session_.begin ? session_.begin() : 0.0) + position, exposure = due - setup_.latency;
  Clock::time_point now = Clock::now();
  for (; !quit_; now = Clock::now()) {
    const std::optional<double> time = session_.at(now);
    const bool motors = !session_.newest || session_.newest() >= exposure;
    if (time && *time >= std::max(due, exposure) && (motors || *time >= exposure + kSilent)) break;
    std::this_thread::sleep_for(kPeriod);
  }
  return {0, now, due};
}

void CameraSide::readStream(int stream, VideoStream& video) {
  {
    const std::lock_guard lock(mutex_);
    ++status_.connections;
    status_.fault.clear();
  }
  if (video.isFile()) waitForSession();
  cv::Mat image;
  while (!quit_ && video.read(image)) {
    const Times times = video.isFile() ? waitUntilDue(video.position()) : Times{0, video.arrival()};
    take(stream, image, times, 0);
    image.release();  // the next one must not overwrite it
  }
}

void CameraSide::noteHint(TopicHint& hint) {
  const std::optional<std::string> reason = hint.ask();
  if (!reason || reason->empty()) return;
  const std::lock_guard lock(mutex_);
  status_.fault = *reason;
}

/// Until the end: a topic outlives its publishers.
void CameraSide::workOnTopic(int stream, const std::string& topic) {
  constexpr std::chrono::milliseconds kWait{50};
  ros1::TopicReader reader(topic, kWaiting);
  std::uint64_t connections = 0;
  TopicHint hint(topic, ros1::carriesImages, "images");
  while (!quit_) {
    const auto message = reader.next(kWait);
    if (!message) {
      if (connections == 0) noteHint(hint);
      continue;
    }
    try {
      const ros1::StampedImage image = ros1::imageOf(*message);
      {
        const std::lock_guard lock(mutex_);
        status_.connections += reader.connections() - std::exchange(connections, reader.connections());
        status_.fault.clear();
      }
      take(stream, image.image, {image.stamp, message->arrival}, message->lost);
    } catch (const base::InputError& error) {
      const std::lock_guard lock(mutex_);
      status_.fault = "ros:" + topic + ": " + error.what();
    }
  }
}

/// Time by which images are paired [s]: the session's of files, the stamp, or the arrival at this computer
/// since start_ where there are none. An image without a stamp between others with one gets the stamp that
/// would have come with it.
double CameraSide::pairingTime(int stream, const Times& times) {
  if (files_) return times.session;
  const double arrival = std::chrono::duration<double>(times.arrival - start_).count();
  if (times.stamp == 0) return origin_ == 0 ? arrival : clock_.toDevice(arrival);
  if (origin_ == 0) origin_ = times.stamp;
  const double device = ros1::secondsOf(times.stamp - origin_);
  clock_.add(device, arrival, static_cast<std::size_t>(stream));
  return device;
}

/// Time at which images of this time would have arrived with the smallest delay.
CameraSide::Clock::time_point CameraSide::computerTime(double pairing_time) const {
  const double since = origin_ == 0 ? pairing_time : clock_.toSession(pairing_time);
  return start_ + std::chrono::round<Clock::duration>(std::chrono::duration<double>(since));
}

/// Time of a pair on the session's clock [s]. Where motors and images have stamps of the same clock, the
/// stamps tell it, and the arrivals only show whether the clocks agree: by them an image is later by its
/// delay.
std::optional<double> CameraSide::exposureOf(const FramePair& pair) const {
  constexpr double kEarliest = -0.02, kLatest = 0.25;  // delay of the fastest images beyond that of rows [s]
  if (files_) return pair.t;
  const std::optional<double> by_arrival = session_.at(computerTime(pair.t));
  if (origin_ == 0 || !by_arrival) return by_arrival;
  const std::optional<double> by_stamp =
      !session_.of_stamp ? std::nullopt : session_.of_stamp(origin_ + ros1::nanosecondsOf(pair.t));
  const bool agree = by_stamp && *by_arrival - *by_stamp > kEarliest && *by_arrival - *by_stamp < kLatest;
  return agree ? by_stamp : by_arrival;
}

void CameraSide::take(int stream, const cv::Mat& image, const Times& times, std::uint64_t lost) {
  const bool running = session_.at(times.arrival).has_value();
  const std::lock_guard lock(mutex_);
  Newest& newest = newest_[static_cast<std::size_t>(stream)];
  newest.image = times.arrival;
  status_.state = State::kReceiving;
  ++status_.received;
  const double t = pairingTime(stream, times);
  if (!running) {
    newest.change = times.arrival;
    return;
  }
  std::optional<FramePair> pair;
  if (setup_.layout == CameraLayout::kTwo) {
    pair = pairer_.add(stream, t, image, lost);
  } else {
    auto eyes = eyesOf(image, setup_.layout);
    pairer_.add(0, t, eyes[0], lost);
    pair = pairer_.add(1, t, eyes[1], lost);
  }
  if (!pairer_.isFrozen(stream)) newest.change = times.arrival;
  // A frozen image shows an earlier time than its own: the pair would mislead the filter.
  if (pair && !pair->frozen) pass(std::move(*pair), times.arrival);
}

void CameraSide::pass(FramePair pair, Clock::time_point arrival) {
  const std::optional<double> now = session_.at(arrival), seen = exposureOf(pair);
  if (!now || !seen) return;
  const double t = *seen - setup_.latency;
  gaps_.add(t);
  status_.missing = gaps_.missing();
  if (!queue_.offer(tracking::StereoFrame{t, *now, std::move(pair.left), std::move(pair.right), pair.skew}))
    ++status_.dropped;
}

}  // namespace capstan::live
