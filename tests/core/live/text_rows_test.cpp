/// The last row of a connection, pipe or file.
#include "core/live/text_rows.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "core/robot/description.h"
#include "tests/support/temporary_folder.h"

namespace capstan::live {
namespace {

constexpr const char* kHeader = "t,q_m1,q_m2,q_m3\n";

std::string numbersFrom(int first, int count) {
  std::string text;
  for (int k = first; k < first + count; ++k) text += std::to_string(1e-3 * k) + ",80,-90,-480\n";
  return text;
}

TEST(RowParser, ARowThatIsCutOffIsDiscarded) {
  RowParser parser("rows", robot::readDescriptionOrDefault({}), {});
  parser.add(kHeader + numbersFrom(0, 51) + "0.052,82,-90,-48");
  EXPECT_TRUE(parser.discardIncomplete());
  EXPECT_FALSE(parser.discardIncomplete());
  EXPECT_EQ(parser.take(true)->rows(), 51U);
  parser.add("0.053,8");
  EXPECT_TRUE(parser.discardIncomplete());
  EXPECT_FALSE(parser.take(true));
  parser.restart();
  parser.add("t,q_m1");
  EXPECT_FALSE(parser.discardIncomplete()) << "a header is no row";
}

/// The last row has no line feed: of a file it is a row, of a pipe it may be cut off.
TEST(TextRows, OnlyAFileHasALastRowWithoutALineFeed) {
  const int before = ::dup(STDIN_FILENO);
  const auto rowsOf = [](int input) {
    ::dup2(input, STDIN_FILENO);
    const robot::Description robot = robot::readDescriptionOrDefault({});
    TextRows rows(openByteStream(parseAddress("-", "--live")), RowParser("-", robot, {}));
    std::size_t count = 0;
    for (ReadState state = ReadState::kNothing; state != ReadState::kEnded;) {
      state = rows.read(std::chrono::milliseconds(100));
      if (const auto table = rows.take()) count += table->rows();
    }
    return std::pair(count, rows.incomplete());
  };
  const std::string text = kHeader + numbersFrom(0, 60) + "0.060,80,-90,-48";
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  ASSERT_EQ(::write(pipe[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(pipe[1]);
  EXPECT_EQ(rowsOf(pipe[0]), std::pair(std::size_t{60}, std::uint64_t{1}));
  ::close(pipe[0]);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  std::fputs(text.c_str(), file.get());
  std::rewind(file.get());
  EXPECT_EQ(rowsOf(::fileno(file.get())), std::pair(std::size_t{61}, std::uint64_t{0}));
  ::dup2(before, STDIN_FILENO);
  ::close(before);
}

/// A FIFO does not tell when a program opens it: the first bytes do.
TEST(TextRows, NoLongerSaysThatNobodyConnectsWhenBytesCome) {
  const test::TemporaryFolder folder;
  const std::string fifo = (folder / "rows").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  TextRows rows(openByteStream(parseAddress(fifo, "--live")),
                RowParser("rows", robot::readDescriptionOrDefault({}), {}), std::chrono::milliseconds(0));
  rows.read(std::chrono::milliseconds(1));
  EXPECT_THAT(rows.hint(), testing::Optional(testing::HasSubstr("no program has connected")));
  const int program = ::open(fifo.c_str(), O_WRONLY | O_NONBLOCK);
  ASSERT_GE(program, 0);
  ASSERT_EQ(::write(program, "t,q_m1", 6), 6);
  for (int k = 0; k < 100 && rows.hint() != ""; ++k) rows.read(std::chrono::milliseconds(10));
  EXPECT_EQ(rows.hint(), "");
  ::close(program);
}

/// A program that sends to another port.
TEST(TextRows, SaysThatNobodyConnects) {
  const robot::Description robot = robot::readDescriptionOrDefault({});
  TextRows rows(openByteStream(parseAddress("tcp://127.0.0.1:0", "--live")), RowParser("rows", robot, {}),
                std::chrono::milliseconds(300));
  EXPECT_FALSE(rows.hint()) << "it may still come";
  std::this_thread::sleep_for(std::chrono::milliseconds(301));
  const std::optional<std::string> hint = rows.hint();
  ASSERT_TRUE(hint);
  EXPECT_NE(hint->find("no program has connected to tcp://127.0.0.1:"), std::string::npos) << *hint;
}

}  // namespace
}  // namespace capstan::live
