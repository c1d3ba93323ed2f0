#include "tests/support/attacked_side.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/live/streams/tcp_sender.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::testing {
namespace {

using namespace std::chrono_literals;
using State = tracking::SideStatus::State;
constexpr int kRobotRows = 60;

template <class Done>
bool eventually(const Done& done) {
  const auto end = std::chrono::steady_clock::now() + 5s;
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(200us);
  }
  return true;
}

}  // namespace

AttackedSide::AttackedSide()
    : source_(live::liveSetupOf("tcp://127.0.0.1:0", {}, {})),
      address_(live::parseAddress(source_.sides().front().from, "address")),
      thread_([this] { track(); }) {}

AttackedSide::~AttackedSide() {
  quit_ = true;
  thread_.join();
}

void AttackedSide::track() {
  tracking::TrackingPipeline pipeline = tracking::makePipeline(source_.info(), {});
  double last = -1.0;
  for (tracking::Sample sample; !quit_;) {
    if (!source_.ready(10ms)) continue;
    if (!source_.next(sample)) break;
    const tracking::Snapshot& snapshot = pipeline.step(sample);
    const auto* motor = std::get_if<tracking::MotorSample>(&sample);
    if (!motor) continue;
    if (!(motor->t > last)) backwards_ = true;
    last = motor->t;
    finite_ = snapshot.q_link_ukf.allFinite() && snapshot.q_link_kin.allFinite();
    ++tracked_;
  }
  ended_ = true;
}

void AttackedSide::fail(const MutatedStream& stream, const std::string& what) {
  failures_.push_back(fmt::format("{}: {}", stream.kind, what));
}

void AttackedSide::send(const MutatedStream& stream) {
  sendMutated(stream);
  sendRobot(stream);
  if (ended_) fail(stream, "the motor side has ended");
  if (backwards_.exchange(false)) fail(stream, "the session's clock went back");
}

/// When nothing has been counted for some time, and nobody is connected that has sent rows.
tracking::SideStatus AttackedSide::statusAtRest() const {
  constexpr auto kRest = 5ms, kMost = 5000ms;
  const auto begin = std::chrono::steady_clock::now();
  tracking::SideStatus seen = status();
  for (auto since = begin; std::chrono::steady_clock::now() - begin < kMost;) {
    std::this_thread::sleep_for(500us);
    const tracking::SideStatus now = status();
    const bool same = now.received == seen.received && now.refused == seen.refused &&
                      now.repeated == seen.repeated && now.state == seen.state;
    if (!same) since = std::chrono::steady_clock::now();
    seen = now;
    const bool ended = now.state != State::kReceiving && now.state != State::kSilent;
    if (ended && std::chrono::steady_clock::now() - since > kRest) break;
  }
  return seen;
}

void AttackedSide::sendMutated(const MutatedStream& stream) {
  const tracking::SideStatus before = status();
  MutationCounts& counts = counts_[stream.kind];
  std::string answer;
  {
    live::TcpSender sender(address_);
    for (const std::string& piece : stream.pieces) {
      if (!sender.send(piece)) break;
      if (stream.pieces.size() > 1) std::this_thread::sleep_for(1ms);
    }
    // The side has taken the connection; what it says at once is read.
    eventually([&] { return status().connections > before.connections; });
    const auto end = std::chrono::steady_clock::now() + 2ms;
    while (answer.empty() && std::chrono::steady_clock::now() < end) answer = sender.answer();
  }
  const tracking::SideStatus after = statusAtRest();
  if (after.state != State::kWaiting && after.state != State::kRefused)
    fail(stream, "the connection did not end");
  ++counts.streams;
  counts.refused += after.refused - before.refused;
  counts.rows += after.received - before.received;
  counts.steps += after.clock ? after.clock->steps - (before.clock ? before.clock->steps : 0) : 0;
  if (answer.starts_with("error: ")) ++counts.answered;
  if (!answer.empty() && (!answer.starts_with("error: ") || !answer.ends_with('\n')))
    fail(stream, "the answer is no error: " + answer);
  if (after.refused > before.refused && after.fault.find(after.from) == std::string::npos)
    fail(stream, "the fault does not name the stream: " + after.fault);
}

void AttackedSide::sendRobot(const MutatedStream& stream) {
  const tracking::SideStatus before = status();
  const std::uint64_t tracked = tracked_;
  live::TcpSender robot(address_);
  if (!robot.send(validRows(kRobotRows))) return fail(stream, "the robot is disconnected: " + robot.answer());
  if (!eventually([&] { return status().received - before.received >= kRobotRows; }))
    fail(stream, fmt::format("{} of the robot's {} rows are taken, {} are repeated {}",
                             status().received - before.received, kRobotRows,
                             status().repeated - before.repeated, robot.answer()));
  if (!eventually([&] { return tracked_ - tracked >= kRobotRows; }))
    fail(stream, "the robot's rows are not tracked");
  if (!finite_) fail(stream, "the estimates are not finite any more");
}

}  // namespace capstan::testing
