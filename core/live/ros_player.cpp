#include "core/live/ros_player.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <thread>
#include <tuple>

#include "core/ros1/master_topics.h"
#include "core/ros1/stamp.h"
#include "core/tracking/arrival.h"

namespace capstan::live {
namespace {

using tracking::MotorSample;
using tracking::Sample;
using tracking::StereoFrame;

/// ROS time of a sample of the recording [ns]: as if it had been recorded now, whatever the speed.
std::int64_t stampOf(const PlayClock& clock, double t) {
  return ros1::nanosecondsOf(clock.started) + ros1::nanosecondsOf(t - clock.begin);
}

}  // namespace

RosPlayer::RosPlayer(const tracking::SourceInfo& info) : messages_(info) {
  if (!ros1::isMasterThere()) ros1::refuseWithoutMaster();
  // What a program needs before the first sample is latched: it can come late.
  std::vector<ros1::OutMessage> facts = messages_.calibration(ros1::rosTimeNow());
  facts.push_back(messages_.session(0));
  for (const ros1::OutMessage& fact : facts)
    writers_.try_emplace(fact.topic, fact.topic, *fact.type, true).first->second.publish(fact.bytes);
  for (const auto& [topic, type] : messages_.topics()) writers_.try_emplace(topic, topic, *type);
}

RosPlayer::~RosPlayer() = default;

std::string RosPlayer::words() const {
  std::vector<std::string> topics;
  for (const auto& [topic, writer] : writers_) topics.push_back(topic);
  return fmt::format("{}", fmt::join(topics, ", "));
}

bool RosPlayer::waitForSubscribers(Topics topics, std::chrono::milliseconds patience,
                                   const base::Progress* progress) const {
  const ros1::BagTopics ours = ros1::ourTopics();
  const std::vector<std::string> needed =
      topics == Topics::kMotors ? std::vector{ours.motors} : std::vector{ours.left, ours.right};
  const auto end = std::chrono::steady_clock::now() + patience;
  const auto taken = [&](const std::string& topic) {
    const auto writer = writers_.find(topic);
    return writer != writers_.end() && writer->second.subscribers() > 0;
  };
  while (!std::ranges::all_of(needed, taken)) {
    if (std::chrono::steady_clock::now() > end || (progress && progress->cancelled())) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

void RosPlayer::publish(const Sample& sample, std::int64_t stamp) {
  for (const ros1::OutMessage& message : messages_.of(sample, stamp))
    if (const auto writer = writers_.find(message.topic); writer != writers_.end())
      writer->second.publish(message.bytes);
}

bool RosPlayer::hasSubscriber() const {
  const auto motors = writers_.find(ros1::ourTopics().motors);
  return motors != writers_.end() && motors->second.subscribers() > 0;
}

/// A message that ends too early.
void RosPlayer::publishDamaged(const Sample& sample) {
  ros1::OutMessage message = messages_.of(sample, ros1::rosTimeNow()).front();
  message.bytes.resize(message.bytes.size() / 2);
  writers_.at(message.topic).publish(message.bytes);
}

PlayReport RosPlayer::playRows(tracking::Source& source, const PlayClock& clock, const PlayOptions& options,
                               base::Progress* progress) {
  PlayReport report;
  FaultyRows rows(options.faults, options.seed);
  const auto start = std::chrono::steady_clock::now();
  std::optional<MotorSample> shown;   // whose values are sent
  std::optional<double> shift = 0.0;  // of the stamps of the last motors; nothing: they were withheld
  std::size_t row = 0;
  for (Sample sample; source.next(sample) && !(progress && progress->cancelled());) {
    if (std::holds_alternative<StereoFrame>(sample)) continue;
    const double t = std::visit([](const auto& one) { return one.t; }, sample);
    const auto* motor = std::get_if<MotorSample>(&sample);
    if (!motor) {
      if (shift) publish(sample, stampOf(clock, t + *shift));
      continue;
    }
    const auto played = rows.next(row, t, clock.begin);
    shift = played ? std::optional(played->stamp - t) : std::nullopt;
    if (!played) {
      ++report.withheld;
    } else {
      if (played->row == row || !shown) shown = *motor;
      clock.waitUntil(played->due);
      if (played->garbage) publishDamaged(*shown);
      for (int times = played->twice ? 2 : 1; times > 0; --times)
        publish(*shown, stampOf(clock, played->stamp));
      ++(hasSubscriber() ? report.sent : report.lost);
    }
    if (progress && row % 256 == 0 && source.info().duration > 0.0)
      progress->report((t - clock.begin) / source.info().duration, "playing");
    ++row;
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

ImagePlayReport RosPlayer::playImages(tracking::Source& source, const PlayClock& clock,
                                      const PlayOptions& options, const base::Progress* progress) {
  ImagePlayReport report;
  FaultyRows pairs(options.faults, options.seed);
  StereoFrame shown;
  ImagePacer pacer(clock, report);
  std::size_t pair = 0;
  for (Sample sample; source.next(sample) && !(progress && progress->cancelled());) {
    const auto* frame = std::get_if<StereoFrame>(&sample);
    if (!frame) continue;
    const auto played = pairs.next(pair, frame->t_arrival, clock.begin);
    if (played && played->row == pair)
      shown = {frame->t, frame->t_arrival, frame->left.clone(), frame->right.clone()};
    ++pair;
    if (!played) {
      ++report.withheld;
      continue;
    }
    if (!pacer.wait(played->due)) continue;
    StereoFrame sent = shown;
    if (played->swapped) std::swap(sent.left, sent.right);
    publish(sent, stampOf(clock, frame->t));
  }
  return report;
}

}  // namespace capstan::live
