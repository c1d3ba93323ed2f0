// Plain sockets and FIFOs are the readers.
#include "core/live/streams/row_stream.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <thread>

#include "core/base/error.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;

FileDescriptor connectTo(const RowStream& stream) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(parseAddress(stream.name(), "").port);
  inet_pton(AF_INET, "127.0.0.1", &to.sin_addr);
  EXPECT_EQ(::connect(socket.get(), reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  return socket;
}

/// Waits until `count` readers have connected.
void waitForReaders(const RowStream& stream, std::uint64_t count) {
  for (int i = 0; i < 500 && stream.counts().readers < count; ++i) std::this_thread::sleep_for(10ms);
  ASSERT_EQ(stream.counts().readers, count);
}

std::string readToEnd(int file) {
  std::string text(1 << 16, '\0'), all;
  for (ssize_t count = 1; (count = ::read(file, text.data(), text.size())) > 0;)
    all.append(text, 0, static_cast<std::size_t>(count));
  return all;
}

std::string rowsFrom(int first, int last) {
  std::string text;
  for (int i = first; i < last; ++i) text += fmt::format("{}\n", i);
  return text;
}

TEST(RowStream, EveryReaderGetsTheHeaderAndAllRowsFromThenOn) {
  RowStream stream(parseAddress("tcp://127.0.0.1:0", ""), "header\n");
  stream.send("nobody reads this\n");
  std::this_thread::sleep_for(100ms);
  const FileDescriptor early = connectTo(stream);
  waitForReaders(stream, 1);
  for (int i = 0; i < 500; ++i) stream.send(fmt::format("{}\n", i));
  std::this_thread::sleep_for(200ms);
  const FileDescriptor late = connectTo(stream);
  waitForReaders(stream, 2);
  for (int i = 500; i < 1000; ++i) stream.send(fmt::format("{}\n", i));
  stream.close();
  EXPECT_EQ(readToEnd(early.get()), "header\n" + rowsFrom(0, 1000));
  EXPECT_EQ(readToEnd(late.get()), "header\n" + rowsFrom(500, 1000));
  EXPECT_EQ(stream.counts().rows, 1001U);
  EXPECT_EQ(stream.counts().dropped, 0U);
}

TEST(RowStream, AReaderThatDoesNotReadLosesWholeRowsAndSlowsNobody) {
  const std::string filler(1000, 'x');
  constexpr int kRows = 20'000;  // 20 MB: more than the system's buffers
  RowStream stream(parseAddress("tcp://127.0.0.1:0", ""), "");
  const FileDescriptor dead = connectTo(stream), reader = connectTo(stream);
  waitForReaders(stream, 2);
  std::string got;
  std::thread reading([&] { got = readToEnd(reader.get()); });
  for (int i = 0; i < kRows; ++i) {
    stream.send(fmt::format("{} {}\n", i, filler));  // would wait for ever if it waited for the dead reader
    if (i % 100 == 0) std::this_thread::sleep_for(2ms);
  }
  stream.close();
  reading.join();
  const RowStreamCounts counts = stream.counts();
  EXPECT_GT(counts.dropped, 1000U);
  EXPECT_EQ(std::count(got.begin(), got.end(), '\n'), std::count(got.begin(), got.end(), ' '));
  EXPECT_GT(std::count(got.begin(), got.end(), '\n'), kRows / 2);
  const std::string some = [&] {  // of the dead reader: no row is cut but the last one at the end
    std::string text(1 << 20, '\0');
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, ::read(dead.get(), text.data(), text.size()))));
    return text;
  }();
  EXPECT_TRUE(some.starts_with("0 x"));
}

/// Opens the FIFO until the stream takes it for reader number `count`. A program that opens it before the
/// stream has noticed that the last one left is taken for the same reader: nothing in a FIFO tells them
/// apart.
FileDescriptor openAsReader(const std::string& path, const RowStream& stream, std::uint64_t count) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    FileDescriptor reader(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    for (int i = 0; i < 50 && stream.counts().readers < count; ++i) std::this_thread::sleep_for(10ms);
    if (stream.counts().readers == count) return reader;
    reader.close();
    std::this_thread::sleep_for(100ms);
  }
  return FileDescriptor();
}

TEST(RowStream, AFifoMayLoseItsReaderAndGetAnother) {
  const std::string path =
      (std::filesystem::temp_directory_path() / fmt::format("rows_{}.fifo", getpid())).string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  {
    RowStream stream(parseAddress(path, ""), "header\n");
    for (std::uint64_t readers = 1; readers <= 2; ++readers) {
      const FileDescriptor reader = openAsReader(path, stream, readers);
      ASSERT_TRUE(reader.isOpen()) << "reader " << readers;
      stream.send("row\n");
      std::string text;
      while (text.size() < std::string("header\nrow\n").size()) {
        std::array<char, 64> bytes;
        const ssize_t count = ::read(reader.get(), bytes.data(), bytes.size());
        ASSERT_GT(count, 0);
        text.append(bytes.data(), static_cast<std::size_t>(count));
      }
      EXPECT_EQ(text, "header\nrow\n");
    }
  }
  std::filesystem::remove(path);
}

TEST(RowStream, APortInUseIsRefused) {
  const RowStream stream(parseAddress("tcp://127.0.0.1:0", ""), "");
  EXPECT_THROW(RowStream(parseAddress(stream.name(), ""), ""), base::InputError);
}

}  // namespace
}  // namespace capstan::live
