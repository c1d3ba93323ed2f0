#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/recording/recorder.h"
#include "core/recording/session_reader.h"
#include "core/recording/session_source.h"
#include "tests/core/recording/session_samples.h"

/// A child process that records at the real rate (1 kHz motors, joints and estimates, 2 × 15 images a second
/// of 640×480) until it is killed, and what its file then holds.
namespace capstan::recording::testing {

enum Kind { kMotors, kJoints, kFrames, kEstimates, kKinds };

/// In memory that outlives the child: when each sample was offered, on the clock that all processes share.
struct OfferLog {
  static constexpr std::size_t kMost = 1U << 16;
  std::array<std::atomic<std::uint32_t>, kKinds> count;
  std::array<std::array<double, kMost>, kKinds> offered;

  void add(Kind kind, double now) {
    const std::uint32_t index = count[kind].load(std::memory_order_relaxed);
    if (index >= kMost) return;
    offered[kind][index] = now;
    count[kind].store(index + 1, std::memory_order_release);
  }
};

inline double monotonicSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Pictures are known by their number, so that a survivor can be compared to the last bit.
inline cv::Mat numberedImage(std::uint32_t number, int side) {
  base::Random random(number % 8 * 2 + static_cast<std::uint32_t>(side), "picture");
  cv::Mat image(480, 640, CV_8UC3);
  for (int row = 0; row < image.rows; ++row) {
    std::uint64_t noise = random.bits();
    for (int i = 0; i < 3 * image.cols; ++i) {
      noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
      image.ptr(row)[i] = static_cast<std::uint8_t>(90 + ((i + row) >> 4) + static_cast<int>(noise >> 61));
    }
  }
  return image;
}

/// Never returns.
[[noreturn]] inline void recordUntilKilled(const std::filesystem::path& path, OfferLog& log) {
  std::vector<std::array<cv::Mat, 2>> pictures;
  for (std::uint32_t i = 0; i < 8; ++i) pictures.push_back({numberedImage(i, 0), numberedImage(i, 1)});
  Recorder recorder(path, header());
  base::Random random(1);
  tracking::Snapshot snapshot = someSnapshot(random);
  const double begin = monotonicSeconds();
  for (std::uint32_t tick = 0;; ++tick) {
    const double t = tick * 1e-3;
    while (monotonicSeconds() - begin < t) usleep(200);
    const auto offer = [&](Kind kind, const auto& what) {
      const double now = monotonicSeconds();
      if (recorder.offer(what)) log.add(kind, now);
    };
    offer(kMotors, tracking::Sample(tracking::MotorSample{t, {double(tick), 1, 2}, {3, 4, 5}, {6, 7, 8}}));
    offer(kJoints, tracking::Sample(tracking::JointSample{t, {double(tick), 1, 2}}));
    snapshot.t = t;
    offer(kEstimates, snapshot);
    if (tick % 66 != 0) continue;
    const auto& picture = pictures[tick / 66 % 8];
    offer(kFrames, tracking::Sample(tracking::StereoFrame{t, t + 0.03, picture[0], picture[1]}));
  }
}

struct KillOutcome {
  bool opened = false;
  bool intact = false;          ///< counts from zero without gaps, surviving pictures bit-exact
  double oldest_lost = 0.0;     ///< age at the kill of the oldest sample that is not in the file [s]
  std::uint32_t lost_late = 0;  ///< samples older than 0.5 s that are not in the file
  std::uint32_t offered = 0;
  std::uint64_t bytes = 0;
  std::string error;
};

inline void compare(const std::filesystem::path& path, const OfferLog& log, double killed,
                    KillOutcome& outcome) {
  const SessionSummary summary = readSessionSummary(path);
  outcome.opened = true;
  outcome.bytes = summary.bytes;
  const std::int64_t stored[] = {summary.motor, summary.joint, summary.frames, summary.estimates};
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const std::uint32_t count = log.count[kind].load(std::memory_order_acquire);
    outcome.offered += count;
    for (std::uint32_t i = static_cast<std::uint32_t>(stored[kind]); i < count; ++i) {
      const double age = killed - log.offered[kind][i];
      outcome.oldest_lost = std::max(outcome.oldest_lost, age);
      outcome.lost_late += age > 0.5;
    }
  }
  SessionSource source(path);
  std::uint32_t motors = 0, frames = 0;
  outcome.intact = true;
  for (tracking::Sample sample; source.next(sample);) {
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample))
      outcome.intact &= motor->position(0) == motors++;
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (!frame) continue;
    outcome.intact &=
        sameBits(frame->left, numberedImage(frames, 0)) && sameBits(frame->right, numberedImage(frames, 1));
    ++frames;
  }
}

/// Records into `path` in a child, kills it with SIGKILL after `seconds` of recording, and looks.
inline KillOutcome recordAndKill(const std::filesystem::path& path, double seconds) {
  void* shared = mmap(nullptr, sizeof(OfferLog), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* log = new (shared) OfferLog;
  const pid_t child = fork();
  if (child == 0) recordUntilKilled(path, *log);
  while (log->count[kMotors].load(std::memory_order_acquire) == 0) usleep(1000);
  usleep(static_cast<useconds_t>(seconds * 1e6));
  const double killed = monotonicSeconds();
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  KillOutcome outcome;
  try {
    compare(path, *log, killed, outcome);
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  munmap(shared, sizeof(OfferLog));
  return outcome;
}

}  // namespace capstan::recording::testing
