#include "core/live/streams/byte_stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/live/streams/file_descriptor.h"
#include "core/live/streams/tcp_listener.h"

namespace capstan::live {
namespace {

constexpr std::size_t kChunk = 1U << 16;

/// Standard input, a FIFO or a file. A FIFO goes on when one writer leaves and another one comes.
class FileStream final : public ByteStream {
 public:
  /// `mode`: st_mode of the file.
  FileStream(FileDescriptor file, std::string name, mode_t mode)
      : file_(std::move(file)), name_(std::move(name)), fifo_(S_ISFIFO(mode)), regular_(S_ISREG(mode)) {}

  ReadState read(std::string& out, std::chrono::milliseconds wait) override {
    pollfd poll{file_.get(), POLLIN, 0};
    const int ready = ::poll(&poll, 1, static_cast<int>(wait.count()));
    if (ready < 0 && errno != EINTR) fail();
    if (ready <= 0) return ReadState::kNothing;
    const std::size_t before = out.size();
    out.resize(before + kChunk);
    const ssize_t count = ::read(file_.get(), out.data() + before, kChunk);
    out.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count > 0) {
      written_ = true;
      return ReadState::kBytes;
    }
    if (count < 0) {
      if (errno == EINTR || errno == EAGAIN) return ReadState::kNothing;
      fail();
    }
    return fifo_ ? writerLeft() : ReadState::kEnded;
  }

  void refuse(const std::string&) override {
    if (fifo_) writerLeft();
  }
  bool isFile() const override { return regular_; }
  std::string name() const override { return name_; }

 private:
  /// Without a writer poll() returns at once; opening the FIFO again makes it wait, and drops unread bytes.
  ReadState writerLeft() {
    file_ = FileDescriptor(::open(name_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    if (!file_.isOpen()) fail();
    return std::exchange(written_, false) ? ReadState::kClosed : ReadState::kNothing;
  }
  [[noreturn]] void fail() const {
    throw base::InputError({name_,
                            0,
                            {},
                            {},
                            std::string("cannot be read: ") + std::strerror(errno),
                            "Check the program that writes it"});
  }

  FileDescriptor file_;
  std::string name_;
  bool fifo_ = false, regular_ = false, written_ = false;
};

std::unique_ptr<ByteStream> openFile(const std::string& path) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat facts {};
  if (!file.isOpen() || ::fstat(file.get(), &facts) != 0 || S_ISDIR(facts.st_mode))
    throw base::InputError({path, 0, {}, {}, "cannot be opened", "Check the path and its permissions"});
  return std::make_unique<FileStream>(std::move(file), path, facts.st_mode);
}

}  // namespace

std::unique_ptr<ByteStream> openByteStream(const Address& address) {
  switch (address.kind) {
    case Address::Kind::kTcp:
      return std::make_unique<TcpListener>(address);
    case Address::Kind::kFile:
      return openFile(address.path);
    case Address::Kind::kRos:
      throw base::InputError({"ros:" + address.path,
                              0,
                              {},
                              {},
                              "is a ROS topic, which sends no text",
                              "Give an address of text"});
    case Address::Kind::kStandardInput:
      break;
  }
  // A pipe ends with its writer: nobody can open it again, as a FIFO of the file system.
  struct stat facts {};
  const bool file = ::fstat(STDIN_FILENO, &facts) == 0 && S_ISREG(facts.st_mode);
  return std::make_unique<FileStream>(FileDescriptor(::dup(STDIN_FILENO)), "standard input",
                                      file ? S_IFREG : mode_t{0});
}

}  // namespace capstan::live
