#include "core/live/streams/row_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "core/base/error.h"
#include "core/live/streams/listening_socket.h"

namespace capstan::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRetry = 100;                   ///< between two trials to open a FIFO [ms]
constexpr std::chrono::seconds kPatience{2};  ///< for readers at the end
constexpr std::size_t kPiece = 4096;          ///< bytes that a pipe with room takes at once (PIPE_BUF)

/// A write to a pipe without reader returns an error in this thread instead of ending the program.
void blockPipeSignal() {
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
}

}  // namespace

RowStream::RowStream(const Address& address, std::string header)
    : header_(std::move(header)), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  open(address);
  thread_ = std::thread([this] { work(); });
}

RowStream::~RowStream() { close(); }

void RowStream::open(const Address& address) {
  switch (address.kind) {
    case Address::Kind::kTcp: {
      ListeningSocket listening = listenOn(address);
      listener_ = std::move(listening.socket);
      name_ = std::move(listening.name);
      return;
    }
    case Address::Kind::kFile:
      name_ = fifo_ = address.path;
      return;
    case Address::Kind::kRos:
      throw base::InputError({"ros:" + address.path,
                              0,
                              {},
                              {},
                              "is a ROS topic, which takes no text",
                              "Give a file, a FIFO, tcp://ADDRESS:PORT or - for standard output"});
    case Address::Kind::kStandardInput:
      name_ = "standard output";
      add(FileDescriptor(::dup(STDOUT_FILENO)), false);
  }
}

void RowStream::send(const std::string& row) {
  ++sent_;
  {
    const std::lock_guard lock(mutex_);
    if (bytes_ + row.size() > kMostBytes) {
      ++dropped_;
      return;
    }
    bytes_ += row.size();
    rows_.push_back(row);
  }
  const std::uint64_t one = 1;
  (void)!::write(wake_.get(), &one, sizeof one);
}

void RowStream::close() {
  if (!thread_.joinable()) return;
  closing_ = true;
  const std::uint64_t one = 1;
  (void)!::write(wake_.get(), &one, sizeof one);
  thread_.join();
  readers_.clear();
  listener_.close();
}

RowStreamCounts RowStream::counts() const { return {sent_, dropped_, connected_}; }

void RowStream::add(FileDescriptor file, bool socket) {
  ++connected_;
  readers_.push_back({std::move(file), header_, socket});
}

void RowStream::accept() {
  FileDescriptor caller(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (caller.isOpen() && readers_.size() < kMostReaders) add(std::move(caller), true);
}

void RowStream::openFifo() {
  FileDescriptor fifo(::open(fifo_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
  if (fifo.isOpen()) add(std::move(fifo), false);
}

void RowStream::distribute() {
  std::deque<std::string> rows;
  {
    const std::lock_guard lock(mutex_);
    rows.swap(rows_);
    bytes_ = 0;
  }
  for (const std::string& row : rows)
    for (Reader& reader : readers_) {
      if (reader.waiting.size() + row.size() > kMostBytes)
        ++dropped_;
      else
        reader.waiting += row;
    }
}

bool RowStream::write(Reader& reader) {
  const std::size_t piece = reader.socket ? reader.waiting.size() : std::min(reader.waiting.size(), kPiece);
  const ssize_t count =
      reader.socket ? ::send(reader.file.get(), reader.waiting.data(), piece, MSG_NOSIGNAL | MSG_DONTWAIT)
                    : ::write(reader.file.get(), reader.waiting.data(), piece);
  if (count < 0) return errno == EAGAIN || errno == EINTR;
  reader.waiting.erase(0, static_cast<std::size_t>(count));
  return true;
}

bool RowStream::allTaken() const {
  return std::all_of(readers_.begin(), readers_.end(), [](const Reader& r) { return r.waiting.empty(); });
}

void RowStream::work() {
  blockPipeSignal();
  std::vector<pollfd> polls;
  for (Clock::time_point end{};;) {
    if (!fifo_.empty() && readers_.empty()) openFifo();
    distribute();
    if (closing_) {
      if (end == Clock::time_point{}) end = Clock::now() + kPatience;
      const std::lock_guard lock(mutex_);
      if ((rows_.empty() && allTaken()) || Clock::now() > end) return;
    }
    polls = {{wake_.get(), POLLIN, 0}, {listener_.get(), POLLIN, 0}};
    for (const Reader& reader : readers_)
      polls.push_back({reader.file.get(), static_cast<short>(reader.waiting.empty() ? 0 : POLLOUT), 0});
    ::poll(polls.data(), polls.size(), kRetry);
    std::uint64_t count = 0;
    (void)!::read(wake_.get(), &count, sizeof count);
    for (std::size_t i = readers_.size(); i-- > 0;) {
      const short events = polls[2 + i].revents;
      const bool gone =
          (events & (POLLERR | POLLHUP | POLLNVAL)) != 0 || ((events & POLLOUT) != 0 && !write(readers_[i]));
      if (gone) readers_.erase(readers_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if ((polls[1].revents & POLLIN) != 0) accept();
  }
}

}  // namespace capstan::live
