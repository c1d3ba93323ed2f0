#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/live/streams/address.h"
#include "core/live/streams/file_descriptor.h"

namespace capstan::live {

/// What became of the rows of a stream.
struct RowStreamCounts {
  std::uint64_t rows = 0;     ///< rows given to send()
  std::uint64_t dropped = 0;  ///< of them not sent to a reader, since it was too slow; summed over readers
  std::uint64_t readers = 0;  ///< programs that have connected so far
};

/// Rows of text to other programs while a session runs: to standard output, to a FIFO, or to every program
/// that connects to a TCP port (it listens; up to kMostReaders at a time). A reader gets the header when it
/// connects, then all rows from then on. send() never waits: a thread of its own writes, and a reader that is
/// kMostBytes behind loses whole rows, which are counted.
class RowStream {
 public:
  static constexpr std::size_t kMostBytes = 1U << 20;  ///< that wait for one reader: some 4 s at 1 kHz
  static constexpr std::size_t kMostReaders = 8;

  /// Throws base::InputError where the port cannot be listened on, or the file not be opened.
  RowStream(const Address& address, std::string header);
  /// Waits up to kPatience for readers that have not taken all rows.
  ~RowStream();
  RowStream(const RowStream&) = delete;
  RowStream& operator=(const RowStream&) = delete;

  void send(const std::string& row);
  /// Sends what is waiting, waits for slow readers up to kPatience, and disconnects them.
  void close();
  RowStreamCounts counts() const;
  /// The address, with the port in use.
  const std::string& name() const { return name_; }

 private:
  struct Reader {
    FileDescriptor file;
    std::string waiting;  ///< bytes that it has not taken
    bool socket = false;
  };
  void open(const Address& address);
  void work();
  void accept();
  void openFifo();
  void add(FileDescriptor file, bool socket);
  /// Moves rows to the readers. Holds the lock only while it takes them.
  void distribute();
  static bool write(Reader& reader);  ///< false: the reader has left
  bool allTaken() const;

  std::string name_, header_, fifo_;
  FileDescriptor listener_, wake_;
  std::vector<Reader> readers_;  ///< of the thread
  mutable std::mutex mutex_;
  std::deque<std::string> rows_;
  std::size_t bytes_ = 0;  ///< in rows_
  std::atomic<std::uint64_t> sent_ = 0, dropped_ = 0, connected_ = 0;
  std::atomic<bool> closing_ = false;
  std::thread thread_;
};

}  // namespace capstan::live
