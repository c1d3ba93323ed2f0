#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/error.h"
#include "core/live/play_faults.h"
#include "core/live/streams/address.h"
#include "core/live/streams/igtl_message.h"
#include "core/live/streams/row_parser.h"
#include "core/live/streams/row_times.h"

namespace capstan::live {
namespace {

TEST(Address, NamesStandardInputFilesAndPorts) {
  EXPECT_EQ(parseAddress("-", "--live").kind, Address::Kind::kStandardInput);
  EXPECT_EQ(parseAddress("rows.fifo", "--live").path, "rows.fifo");
  const Address tcp = parseAddress("tcp://localhost:5555", "--live");
  EXPECT_EQ(tcp.host, "127.0.0.1");
  EXPECT_EQ(tcp.port, 5555);
  for (const char* wrong : {"", "tcp://127.0.0.1", "tcp://robot:5555", "tcp://127.0.0.1:99999",
                            "tcp://127.0.0.1:", "tcp://127.0.0.1:5x", "udp://127.0.0.1:5"})
    try {
      parseAddress(wrong, "--live");
      ADD_FAILURE() << wrong;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().key, "--live");
      EXPECT_EQ(error.fault().value, wrong);
    }
}

std::string rowsFrom(int first, int count) {
  std::string text;
  for (int k = first; k < first + count; ++k) text += std::to_string(1e-3 * k) + ",80,-90,-480\n";
  return text;
}
constexpr const char* kHeader = "t,q_m1,q_m2,q_m3\n";

TEST(RowParser, GivesWholeLinesInPieces) {
  RowParser parser("rows", robot::readDescriptionOrDefault({}), {});
  parser.add(kHeader);
  parser.add(rowsFrom(0, 49));
  EXPECT_FALSE(parser.take(false)) << "units are judged by 50 rows";
  parser.add(rowsFrom(49, 2) + "0.05");
  auto first = parser.take(false);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->rows(), 51U);
  parser.add("1,81,-90,-480\n");
  auto second = parser.take(false);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->rows(), 1U);
  EXPECT_EQ(second->t.front(), 0.051);
  EXPECT_EQ(second->q_m[0].front(), 81.0);
  parser.add("0.052,82,-90,-480");
  EXPECT_FALSE(parser.take(false));
  EXPECT_EQ(parser.take(true)->rows(), 1U) << "the last line of a stream that has ended";
}

TEST(RowParser, FaultsNameTheLineOfTheStream) {
  RowParser parser("rows", robot::readDescriptionOrDefault({}), {});
  parser.add(kHeader + rowsFrom(0, 60));
  ASSERT_TRUE(parser.take(false));
  parser.add("0.060,80,oops,-480\n");
  try {
    parser.take(false);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "rows");
    EXPECT_EQ(error.fault().line, 62);
    EXPECT_EQ(error.fault().value, "oops");
  }
}

/// What add() makes take() throw; an empty fault if it throws nothing.
base::InputFault faultOf(RowParser& parser, const std::string& bytes) {
  parser.add(bytes);
  try {
    EXPECT_FALSE(parser.take(false)) << "the first rows are held back";
  } catch (const base::InputError& error) {
    return error.fault();
  }
  return {};
}

TEST(RowParser, RefusesAWrongLineAtOnce) {
  const robot::Description robot = robot::readDescriptionOrDefault({});
  RowParser parser("rows", robot, {});
  EXPECT_EQ(faultOf(parser, "GET / HTTP/1.1\r\n").reason, "is not separated by commas");
  parser.restart();
  EXPECT_EQ(faultOf(parser, "t,q1,q2,q3\n").key, "q_m1") << "no motors";
  parser.restart();
  EXPECT_EQ(faultOf(parser, "t,q_m1,q_m2,q_").line, 0) << "an incomplete line may go on";
  EXPECT_EQ(faultOf(parser, "m3\n").reason, "") << "a header without rows";
  EXPECT_EQ(faultOf(parser, rowsFrom(0, 3)).reason, "");
  const base::InputFault wrong = faultOf(parser, rowsFrom(3, 2) + "0.005,80,oops,-480\n");
  EXPECT_EQ(wrong.line, 7);
  EXPECT_EQ(wrong.value, "oops");
}

TEST(RowParser, RefusesALineWithoutAnEnd) {
  RowParser parser("rows", robot::readDescriptionOrDefault({}), {});
  parser.add(std::string(RowParser::kLongestLine + 1, 'x'));
  EXPECT_THROW(parser.take(false), base::InputError);
}

/// Whatever a stranger sends becomes rows or an error.
TEST(RowParser, TakesNoHarmFromMutatedStreams) {
  const std::string whole = kHeader + rowsFrom(0, 80);
  std::mt19937 random(3);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const robot::Description robot = robot::readDescriptionOrDefault({});
  int refused = 0, taken = 0;
  for (int k = 0; k < 10000; ++k) {
    std::string bytes = whole;
    for (std::size_t change = 0; change <= below(4); ++change) switch (below(4)) {
        case 0:
          bytes[below(bytes.size())] = static_cast<char>(below(256));
          break;
        case 1:
          bytes.resize(1 + below(bytes.size()));
          break;
        case 2:
          bytes.insert(below(bytes.size()), std::string(below(200), static_cast<char>(below(256))));
          break;
        default:
          bytes.erase(below(bytes.size()), below(50));
          if (bytes.empty()) bytes = "t";
      }
    RowParser parser("stranger", robot, {});
    try {
      for (std::size_t at = 0; at < bytes.size(); at += 100) {
        parser.add(std::string_view(bytes).substr(at, 100));
        if (const auto rows = parser.take(at + 100 >= bytes.size())) {
          ++taken;
          ASSERT_LE(rows->rows(), 400U);
        }
      }
    } catch (const base::InputError& error) {
      ++refused;
      ASSERT_EQ(error.fault().file, "stranger");
    }
  }
  EXPECT_GT(refused, 2000);
  EXPECT_GT(taken, 2000);
}

TEST(RowTimes, RiseAlsoWhereTheDifferenceOfTwoClocksRounds) {
  RowTimes times;
  double last = -1.0, arrival = 0.0;
  for (const double stamp :
       {9.87654321e9, 0.1, 0.1 + 1e-9, 0.1 + 2e-9, -9.9e9, -9.9e9 + 2e-6, 1e10, 3.0, 3.0 + 1e-12}) {
    const auto time = times.of(stamp, arrival += 1e-9);
    if (!time) continue;
    EXPECT_GT(*time, last) << stamp;
    last = *time;
  }
}

TEST(RowParser, RefusesTimesBeyondTheRangeOfClocks) {
  RowParser parser("rows", robot::defaultDescription(), {});
  parser.add("t,q_m1,q_m2,q_m3\n1e300,1,2,3\n");
  EXPECT_THROW(parser.take(true), base::InputError);
}

TEST(RowTimes, GoOnWhereTheRowsClockSteps) {
  RowTimes times;
  EXPECT_EQ(times.of(100.0, 5.0), 0.0);
  EXPECT_NEAR(*times.of(100.001, 5.001), 0.001, 1e-12);
  EXPECT_FALSE(times.of(100.001, 5.002)) << "repeated";
  EXPECT_FALSE(times.of(100.0005, 5.002)) << "late";
  EXPECT_FALSE(times.of(99.4, 5.002)) << "a single row that is late by far";
  EXPECT_NEAR(*times.of(100.0022, 5.0022), 0.0022, 1e-9) << "the clock has not stepped";
  EXPECT_FALSE(times.of(99.5, 5.003)) << "back by half a second, or a late row";
  EXPECT_NEAR(*times.of(99.501, 5.004), 0.004, 1e-9) << "the next one tells";
  EXPECT_NEAR(*times.of(7000.0, 5.014), 0.014, 1e-9) << "far ahead";
  EXPECT_NEAR(*times.of(7002.0, 7.014), 2.014, 1e-9) << "a pause of two seconds is none";
  EXPECT_EQ(times.steps(), 2U);
  EXPECT_EQ(times.repeated(), 4U);
}

TEST(RowTimes, GoOnWhereAnotherProgramConnects) {
  RowTimes times;
  EXPECT_EQ(times.of(0.0, 5.0), 0.0);
  EXPECT_NEAR(*times.of(0.05, 5.05), 0.05, 1e-12);
  times.reconnect();
  EXPECT_NEAR(*times.of(0.0, 5.06), 0.06, 1e-9) << "its clock starts at 0 again";
  EXPECT_NEAR(*times.of(0.001, 5.061), 0.061, 1e-9);
  times.reconnect();
  EXPECT_NEAR(*times.of(0.011, 5.071), 0.071, 1e-9) << "the same program as before";
  EXPECT_EQ(times.steps(), 1U);
  EXPECT_EQ(times.repeated(), 0U);
}

/// Rows whose stamps lie in the future, in every way that each row for itself may.
TEST(RowTimes, AreNeverAheadOfThisComputersClock) {
  const auto largestLead = [](const auto& stampOf, double rows_per_arrival) {
    RowTimes times;
    double largest = 0.0, last = -1.0;
    for (int k = 0; k < 200000; ++k) {
      const double arrival = 5.0 + 1e-3 * std::floor(k / rows_per_arrival);
      const auto time = times.of(stampOf(k), arrival);
      if (!time) continue;
      EXPECT_GT(*time, last) << k;
      last = *time;
      largest = std::max(largest, *time - (arrival - 5.0) * (1.0 + RowTimes::kFast));
    }
    return largest;
  };
  constexpr double kLead = RowTimes::kFirstWait + 2.0 * RowTimes::kAhead + 0.2;  // 200 000 rows, each 1 µs
  const auto even = [](int k) { return 1e-3 * k; };
  EXPECT_LT(largestLead(even, 1.0), 1e-9);
  EXPECT_LT(largestLead([](int k) { return 0.29 * k; }, 1.0), kLead) << "each row 0.29 s ahead";
  EXPECT_LT(largestLead([](int k) { return 1e-3 * k + (k % 2) * 0.29; }, 1.0), kLead) << "every other row";
  EXPECT_LT(largestLead([](int k) { return 1e-3 * k + (k % 1000 == 999) * 0.29; }, 1.0), kLead)
      << "one of 1000";
  EXPECT_LT(largestLead(even, 2.0), kLead) << "a clock of twice the rate";
  EXPECT_LT(largestLead([](int k) { return k % 2 * 5.0; }, 100.0), kLead) << "steps within one packet";
}

/// A recording that another program writes as fast as it can: whoever waits as told keeps every stamp.
TEST(RowTimes, TellHowLongARowThatComesFasterThanRealTimeHasToWait) {
  RowTimes times;
  double arrival = 5.0;
  for (int k = 0; k < 10000; ++k) {
    const double stamp = 1e-3 * k, early = times.tooEarly(stamp, arrival);
    EXPECT_GE(early, 0.0);
    arrival += early > 0.0 ? early + 1e-6 : 0.0;
    ASSERT_NEAR(*times.of(stamp, arrival), stamp, 1e-9);
  }
  EXPECT_EQ(times.steps(), 0U);
  const double lead = 1e-3 * 9999 - (arrival - 5.0);
  EXPECT_GT(lead, RowTimes::kFirstWait);
  EXPECT_LT(lead, RowTimes::kFirstWait + 2.0 * RowTimes::kAhead + RowTimes::kFast * 10.0);
  EXPECT_EQ(times.tooEarly(1e9, arrival), 0.0) << "a stamp that jumps";
}

TEST(RowTimes, FollowAClockThatIsFastByAPerThousand) {
  RowTimes times;
  for (int k = 0; k < 3600000; k += 10) {
    const double true_time = 1e-3 * k;
    ASSERT_NEAR(*times.of(1.001 * true_time, 5.0 + true_time), 1.001 * true_time, 1e-6);
  }
  EXPECT_EQ(times.steps(), 0U);
}

/// Rows that were lost while the receiver was held up leave a gap in the stamps, and none in the arrivals.
TEST(RowTimes, TakeABacklogWithLostRowsForNoStep) {
  RowTimes times;
  for (int k = 0; k < 20000; ++k) {
    const double stamp = 1e-3 * k;
    if (stamp >= 10.0 && stamp < 10.8) continue;
    ASSERT_NEAR(*times.of(stamp, 5.0 + (stamp >= 10.0 && stamp < 11.0 ? 11.0 : stamp)), stamp, 1e-9);
  }
  EXPECT_EQ(times.steps(), 0U);
}

/// After an hour in which the clock has lost 0.36 s, under jitter.
TEST(RowTimes, RecogniseAStepOfASlowClock) {
  for (const double step : {0.5, -0.5}) {
    std::mt19937 random(3);
    std::exponential_distribution<double> delay(1.0 / 0.02);
    RowTimes times;
    double last_arrival = 0.0;
    for (int k = 0; k < 370000; ++k) {
      const double t = 1e-2 * k;
      last_arrival = std::max(last_arrival, 5.0 + t + delay(random));
      const auto time = times.of((1.0 - 1e-4) * t + (t > 3600.0 ? step : 0.0), last_arrival);
      if (!time) continue;
      ASSERT_NEAR(*time, (1.0 - 1e-4) * t, t > 3600.0 ? 0.15 : 1e-6) << step;
    }
    EXPECT_EQ(times.steps(), 1U) << step;
    EXPECT_NEAR(times.lastStep(), step, 0.2);
  }
}

/// The receiver is held up for a second at the begin and later: what has waited comes at once.
TEST(RowTimes, KeepTheStampsOfABacklog) {
  RowTimes times;
  for (int k = 0; k < 20000; ++k) {
    const double stamp = 1e-3 * k;
    double arrival = 5.0 + stamp;
    if (stamp < 1.0) arrival = 6.0;
    if (stamp >= 10.0 && stamp < 11.5) arrival = 16.5;
    ASSERT_NEAR(*times.of(stamp, arrival), stamp, 1e-9);
  }
  EXPECT_EQ(times.steps(), 0U);
}

TEST(RowTimes, RiseAfterAStampThatHoldsNoFraction) {
  RowTimes times;
  double last = *times.of(100.0, 5.0);
  for (const double stamp : {1e300, 100.0, -1e300, -1e300, 100.001, 1e17, 100.002, 100.003}) {
    const auto time = times.of(stamp, 5.0 + last);
    if (!time) continue;
    EXPECT_GT(*time, last) << stamp;
    EXPECT_LT(*time, 0.1) << stamp;
    last = *time;
  }
  EXPECT_EQ(times.repeated(), 4U) << "the first row behind tells nothing, nor does an equal one";
}

TEST(HttpAddress, IsParsedAndRefused) {
  const HttpAddress address = parseHttpAddress("http://localhost:8081", "--video");
  EXPECT_EQ(address.host, "127.0.0.1");
  EXPECT_EQ(address.port, 8081);
  for (const char* wrong :
       {"", "tcp://127.0.0.1:8081", "http://127.0.0.1", "http://camera:80", "http://127.0.0.1:x"})
    EXPECT_THROW(parseHttpAddress(wrong, "--video"), base::InputError) << wrong;
}

/// Bytes that the library OpenIGTLink 1.11 makes of the same transform:
/// TransformMessage::SetDeviceName("TipToBase"), SetMatrix(), SetTimeStamp(1, 0x80000000), Pack().
TEST(IgtlMessage, HasTheBytesOfTheLibrary) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.matrix()(0, 1) = 0.25;
  pose.translation().x() = 0.0015;
  std::string hex;
  for (const char byte : igtlTransform("TipToBase", pose, 1.5))
    hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  EXPECT_EQ(
      hex,
      "00015452414e53464f524d000000546970546f426173650000000000000000000000000000018000000000000000000000"
      "30cd482c91a4b4d8233f80000000000000000000003e8000003f8000000000000000000000000000003f8000003fc00000"
      "0000000000000000");
}

TEST(IgtlAddress, IsParsedAndRefused) {
  EXPECT_EQ(parseIgtlAddress("igtl://127.0.0.1:18944", "--publish").port, 18944);
  EXPECT_EQ(parseIgtlAddress("igtl://localhost:0", "--publish").host, "127.0.0.1");
  for (const char* wrong : {"igtl://", "igtl://slicer:18944", "igtl://127.0.0.1", "igtl://127.0.0.1:99999"})
    EXPECT_THROW(parseIgtlAddress(wrong, "--publish"), base::InputError) << wrong;
}

TEST(PlayFault, ParsesItsForms) {
  const PlayFault silence = parseRowFault("silence:2@10", "--fault");
  EXPECT_EQ(silence.kind, PlayFault::Kind::kSilence);
  EXPECT_EQ(silence.amount, 2.0);
  EXPECT_EQ(silence.time, 10.0);
  EXPECT_EQ(parseRowFault("step:-0.5@3", "--fault").amount, -0.5);
  EXPECT_EQ(parseRowFault("garbage@3", "--fault").time, 3.0);
  for (const char* wrong : {"drop", "drop:2", "drop:x", "silence:2", "silence@2", "jitter:0.1@2", "storm:1",
                            "", "drop:-0.1", "garbage:1@2", "silence:1@-2"})
    EXPECT_THROW(parseRowFault(wrong, "--fault"), base::InputError) << wrong;
}

TEST(PlayFault, ImagesHaveFormsOfTheirOwn) {
  EXPECT_EQ(parseImageFault("swap:2@10", "--video-fault").kind, PlayFault::Kind::kSwap);
  EXPECT_EQ(parseImageFault("drop:0.1", "--video-fault").amount, 0.1);
  for (const char* wrong : {"step:0.5@1", "garbage@1", "repeat:0.1", "swap:2"})
    EXPECT_THROW(parseImageFault(wrong, "--video-fault"), base::InputError) << wrong;
  try {
    parseRowFault("swap:2@10", "--fault");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("Write drop:SHARE, repeat:SHARE, jitter:SECONDS, silence:SECONDS@TIME, "
                        "freeze:SECONDS@TIME, step:SECONDS@TIME or garbage@TIME"),
              std::string::npos)
        << error.what();
  }
}

TEST(FaultyRows, SwapImagesForATime) {
  FaultyRows pairs({parseImageFault("swap:0.5@1", "")}, 1);
  for (std::size_t k = 0; k < 30; ++k) {
    const double t = static_cast<double>(k) / 15.0;
    EXPECT_EQ(pairs.next(k, t, 0.0)->swapped, t >= 1.0 && t < 1.5) << t;
  }
}

TEST(FaultyRows, SendWhatTheFaultsLeave) {
  FaultyRows rows({parseRowFault("silence:0.1@0.2", ""), parseRowFault("freeze:0.1@0.5", ""),
                   parseRowFault("step:0.5@0.8", ""), parseRowFault("garbage@0.9", "")},
                  1);
  int garbage = 0;
  for (std::size_t k = 0; k < 1000; ++k) {
    const double t = 3.0 + 1e-3 * static_cast<double>(k), now = t - 3.0;
    const auto sent = rows.next(k, t, 3.0);
    ASSERT_EQ(sent.has_value(), !(now >= 0.2 && now < 0.3)) << now;
    if (!sent) continue;
    EXPECT_EQ(sent->row, now >= 0.5 && now < 0.6 ? 500U : k);
    EXPECT_EQ(sent->stamp, now >= 0.8 ? t + 0.5 : t);
    garbage += sent->garbage;
  }
  EXPECT_EQ(garbage, 1);
}

}  // namespace
}  // namespace capstan::live
