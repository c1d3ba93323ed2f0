/// What a live source keeps while its session is paused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <thread>

#include "core/live/live_source.h"
#include "core/live/streams/tcp_sender.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;

constexpr int kRows = 60;  // by the first 50, units are judged

std::string rows() {
  std::string text = "t,q_m1,q_m2,q_m3\n";
  for (int k = 0; k < kRows; ++k) text += std::to_string(1e-3 * k) + ",80,-90,-480\n";
  return text;
}

/// Standard input of this process for the lifetime of this object: `text`, then its end.
class StandardInput {
 public:
  explicit StandardInput(const std::string& text) : before_(::dup(STDIN_FILENO)) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    EXPECT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
  }
  ~StandardInput() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  const int before_;
};

TEST(LiveSourcePause, RowsOfARobotThatDoesNotWaitAreDiscarded) {
  LiveSource source(liveSetupOf("tcp://127.0.0.1:0", {}, {}));
  TcpSender sender(parseAddress(source.sides().front().from, "address"));
  sender.send(rows());
  for (int k = 0; k < 500 && source.sides().front().received < kRows; ++k) std::this_thread::sleep_for(10ms);
  ASSERT_EQ(source.sides().front().received, kRows);
  EXPECT_EQ(source.sides().front().backlog, 0.0) << "tracking has not begun";
  tracking::Sample sample;
  ASSERT_TRUE(source.next(sample));
  EXPECT_GT(source.sides().front().backlog, 0.0);
  source.discard();
  EXPECT_FALSE(source.ready(0ms));
  EXPECT_EQ(source.sides().front().backlog, 0.0);
}

TEST(LiveSourcePause, RowsOfASenderThatWaitsAreKept) {
  const StandardInput input(rows());
  LiveSource source(liveSetupOf("-", {}, {}));
  for (int k = 0; k < 500 && source.sides().front().received < kRows; ++k) std::this_thread::sleep_for(10ms);
  tracking::Sample sample;
  ASSERT_TRUE(source.next(sample));
  EXPECT_EQ(source.sides().front().backlog, 0.0) << "they are expected to wait";
  source.discard();
  int motors = 1;
  while (source.next(sample)) motors += std::holds_alternative<tracking::MotorSample>(sample);
  EXPECT_EQ(motors, kRows);
}

}  // namespace
}  // namespace capstan::live
