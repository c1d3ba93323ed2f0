#include "core/live/camera_side.h"

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

#include "core/live/cameras/http_images.h"
#include "core/live/cameras/http_url.h"
#include "core/live/streams/address.h"
#include "core/live/topic_hint.h"
#include "core/ros1/bag_topics.h"
#include "core/ros1/received_image.h"
#include "core/ros1/ros_topics.h"

namespace capstan::live {
namespace {

using State = tracking::SideStatus::State;
constexpr std::size_t kWaiting = 16;  // images of a topic that may wait: 0.5 s of 30 images/s

constexpr double kLate = 0.3;  // an image of a file that is later is passed over [s]

/// Left and right half, or upper and lower half, of one image, copied.
std::array<cv::Mat, 2> eyesOf(const cv::Mat& both, CameraLayout layout) {
  if (layout == CameraLayout::kSideBySide) {
    const int half = both.cols / 2;
    return {both.colRange(0, half).clone(), both.colRange(half, 2 * half).clone()};
  }
  const int half = both.rows / 2;
  return {both.rowRange(0, half).clone(), both.rowRange(half, 2 * half).clone()};
}

/// Whether the streams have stamps of two computers. ROS topics have synchronised clocks, or simulated time.
bool mayDiffer(const std::vector<std::string>& addresses) {
  if (addresses.size() != 2 || !std::ranges::all_of(addresses, isHttpAddress)) return false;
  const HttpUrl left = parseHttpUrl(addresses[0]), right = parseHttpUrl(addresses[1]);
  return left.host != right.host || left.port != right.port;
}

std::string joined(const std::array<std::string, 2>& reasons) {
  return reasons[0] + (reasons[0].empty() || reasons[1].empty() ? "" : "; ") + reasons[1];
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
      pairer_(setup.pairing),
      clock_(mayDiffer(addresses_) ? ImageClock::Streams::kMayDiffer : ImageClock::Streams::kOneClock) {
  newest_.fill({start_, start_});
  status_.name = "cameras";
  status_.counted = "image";
  for (const std::string& address : addresses_) {
    status_.from += (status_.from.empty() ? "" : ", ") + withoutPassword(address);
    const bool later = isNetworkStream(address) || isRosTopic(address);
    if (later && !isRosTopic(address)) backlogs_[first_.size()].emplace();
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
  status.dropped += pairer_.dropped(), status.missing = pairer_.missing();
  if (status.state != State::kReceiving)
    status.reason = status.part.empty() ? joined(reasons_) : reasons_[status.part == "left" ? 0 : 1];
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
  if (isRosTopic(address)) {
    try {
      return workOnTopic(stream, rosTopicOf(address));
    } catch (const std::exception& error) {
      return noteReason(stream, error.what());
    }
  }
  std::unique_ptr<VideoStream> video = std::move(first_[static_cast<std::size_t>(stream)]);
  while (!quit_) {
    try {
      if (!video) video = std::make_unique<VideoStream>(address, settingsOf(setup_), &quit_);
      readStream(stream, *video);
    } catch (const std::exception& error) {
      noteReason(stream, error.what());
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

/// By how much the image of a file is late that is read now [s].
double CameraSide::latenessOf(double position) const {
  const std::optional<double> time = session_.at(Clock::now());
  return time ? *time - (session_.begin ? session_.begin() : 0.0) - position : 0.0;
}

/// Reads images of a late file without waiting; if that is not enough, searches in it for the image that is
/// due when it has been found. Returns the number of images that were passed over.
std::uint64_t CameraSide::catchUp(VideoStream& video) const {
  constexpr double kMost = 0.3;  // of reading on [s]
  const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
  const Clock::time_point begin = Clock::now();
  std::uint64_t passed_over = 0;
  for (cv::Mat image; !quit_ && seconds(Clock::now() - begin) < kMost; ++passed_over) {
    if (latenessOf(video.position()) <= 0.0 || !video.read(image)) return passed_over;
  }
  // FFmpeg goes back to a key image and decodes from there, which takes as long as some images.
  constexpr double kSearch = 0.5;  // [s]
  return passed_over + static_cast<std::uint64_t>(video.skip(latenessOf(video.position()) + kSearch));
}

void CameraSide::readStream(int stream, VideoStream& video) {
  noteConnections(stream, 1);
  noteOpened(stream);
  if (video.isFile()) waitForSession();
  cv::Mat image;
  std::uint64_t passed_over = 0;
  while (!quit_ && video.read(image)) {
    const Times times =
        video.isFile() ? waitUntilDue(video.position()) : Times{video.stamp(), video.arrival()};
    if (video.isFile() && latenessOf(video.position()) > kLate) {
      passed_over += 1 + catchUp(video);
      continue;
    }
    take(stream, image, times, video.lost() + std::exchange(passed_over, 0));
    image.release();  // the next one must not overwrite it
  }
  const std::lock_guard lock(mutex_);
  status_.dropped += passed_over;  // before the end of the file
}

void CameraSide::noteOpened(int stream) {
  const std::lock_guard lock(mutex_);
  if (auto& backlog = backlogs_[static_cast<std::size_t>(stream)]) backlog->restart();
}

void CameraSide::noteReason(int stream, std::string reason) {
  const std::lock_guard lock(mutex_);
  reasons_[static_cast<std::size_t>(stream)] = std::move(reason);
}

/// Something comes now.
void CameraSide::noteConnections(int stream, std::uint64_t count) {
  const std::lock_guard lock(mutex_);
  status_.connections += count;
  reasons_[static_cast<std::size_t>(stream)].clear();
}

void CameraSide::noteHint(int stream, TopicHint& hint) {
  const std::optional<std::string> reason = hint.ask();
  if (reason) noteReason(stream, *reason);
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
      if (connections == 0) noteHint(stream, hint);
      continue;
    }
    try {
      const ros1::StampedImage image = ros1::imageOf(*message);
      noteConnections(stream, reader.connections() - std::exchange(connections, reader.connections()));
      take(stream, image.image, {image.stamp, message->arrival}, message->lost);
    } catch (const std::exception& error) {
      noteReason(stream, "ros:" + topic + ": " + error.what());
    }
  }
}

/// Whether an image of either stream has waited: the other's images have no partners then. The image with
/// which the waiting ends has none, either.
bool CameraSide::anyWaits(int stream, const Times& times) {
  auto& own = backlogs_[static_cast<std::size_t>(stream)];
  if (!own || times.stamp != 0) return false;
  const auto waits = [&] {
    return std::ranges::any_of(backlogs_, [](const auto& backlog) { return backlog && backlog->waits(); });
  };
  const bool before = waits();
  own->add(std::chrono::duration<double>(times.arrival - start_).count());
  return before || waits();
}

/// Time by which images are paired [s]: the session's of files, else that of ImageClock.
double CameraSide::pairingTime(int stream, const Times& times) {
  if (files_) return times.session;
  return clock_.add(stream, times.stamp, std::chrono::duration<double>(times.arrival - start_).count());
}

/// Time at which images of this time would have arrived with the smallest delay.
CameraSide::Clock::time_point CameraSide::computerTime(double pairing_time) const {
  return start_ + std::chrono::round<Clock::duration>(
                      std::chrono::duration<double>(clock_.computerTime(pairing_time)));
}

/// Time of a stamp on this computer's clock, if it is since 1970 on a clock that agrees with this computer's.
CameraSide::Clock::time_point CameraSide::onComputer(std::int64_t stamp) {
  using Nanoseconds = std::chrono::nanoseconds;
  constexpr std::chrono::milliseconds kStep{100};
  const Nanoseconds since = std::chrono::system_clock::now().time_since_epoch() -
                            std::chrono::round<Nanoseconds>(Clock::now().time_since_epoch());
  if (computer_since_) computer_steps_ += std::chrono::abs(since - *computer_since_) > kStep;
  computer_since_ = since;
  return Clock::time_point(std::chrono::round<Clock::duration>(Nanoseconds(stamp) - since));
}

/// Time of a pair on the session's clock [s]; nothing while it is not known. It is that of the stamps where
/// they are by the clock of the motors' stamps or of this computer; the arrivals only show whether the clocks
/// agree: by them an image is later by its delay.
std::optional<double> CameraSide::observeExposure(const FramePair& pair) {
  using By = tracking::SideStatus::Times;
  using Verdict = ClockAgreement::Verdict;
  if (files_) return status_.times = By::kFile, pair.t;
  const Clock::time_point arrival = computerTime(pair.t);
  const std::optional<double> by_arrival = session_.at(arrival);
  const std::optional<std::int64_t> stamp = clock_.stampOf(pair.t);
  if (!stamp || !by_arrival) return status_.times = By::kArrivals, by_arrival;
  const Clock::time_point on_computer = onComputer(*stamp);
  const double late = std::chrono::duration<double>(arrival - on_computer).count();
  const Verdict computer = with_computer_.add(late, clock_.steps() + computer_steps_, *by_arrival);
  const std::optional<double> by_stamp = session_.of_stamp ? session_.of_stamp(*stamp) : std::nullopt;
  const int steps = clock_.steps() + (session_.steps ? session_.steps() : 0);
  Verdict motors = Verdict::kDiffer;
  if (by_stamp)
    motors = with_motors_.add(*by_arrival - *by_stamp, steps, *by_arrival);
  else
    with_motors_.forget();
  if (motors == Verdict::kAgree) return status_.times = By::kStamps, by_stamp;
  if (computer == Verdict::kAgree) return status_.times = By::kStamps, session_.at(on_computer);
  if (motors == Verdict::kDiffer && computer == Verdict::kDiffer)
    return status_.times = By::kArrivals, by_arrival;
  ++status_.undated;
  return std::nullopt;
}

void CameraSide::take(int stream, const cv::Mat& image, const Times& times, std::uint64_t lost) {
  const bool running = session_.at(times.arrival).has_value();
  const std::lock_guard lock(mutex_);
  Newest& newest = newest_[static_cast<std::size_t>(stream)];
  newest.image = times.arrival;
  status_.state = State::kReceiving;
  ++status_.received;
  const double t = pairingTime(stream, times);
  if (!running || anyWaits(stream, times)) {
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
  const std::optional<double> now = session_.at(arrival), seen = observeExposure(pair);
  if (!now || !seen) return;
  const double t = *seen - setup_.latency, interval = t - newest_pair_.value_or(t);
  newest_pair_ = t;
  if (interval > tracking::SideStatus::kSilence) ++status_.gaps, status_.last_gap = interval;
  if (!queue_.offer(tracking::StereoFrame{t, *now, std::move(pair.left), std::move(pair.right), pair.skew}))
    ++status_.dropped;
}

}  // namespace capstan::live
