#include "core/table_files/hdf5_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/table_files/expansion.h"
#include "core/table_files/hdf5_file.h"

namespace capstan::table_files {
namespace {

/// Kinds of messages from the process.
enum class Message : char { kColumn = 'c', kValues = 'v', kError = 'e', kEnd = '.' };

/// Sends messages to the other process. Ends this one if it cannot.
class Sender {
 public:
  explicit Sender(int pipe) : pipe_(pipe) {}
  void put(Message kind) { put(&kind, sizeof kind); }
  void put(std::uint64_t number) { put(&number, sizeof number); }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    put(text.data(), text.size());
  }
  void put(const void* bytes, std::size_t size) {
    const auto* at = static_cast<const char*>(bytes);
    while (size > 0) {
      const ssize_t written = ::write(pipe_, at, size);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) ::_exit(1);
      at += written, size -= static_cast<std::size_t>(written);
    }
  }

 private:
  int pipe_;
};

/// Receives them; false: the process has ended before.
class Receiver {
 public:
  explicit Receiver(int pipe) : pipe_(pipe) {}
  bool get(Message& kind) { return get(&kind, sizeof kind); }
  bool get(std::uint64_t& number) { return get(&number, sizeof number); }
  bool get(std::string& text) {
    constexpr std::uint64_t kLongest = 1U << 20;
    std::uint64_t size = 0;
    if (!get(size) || size > kLongest) return false;
    text.resize(size);
    return get(text.data(), size);
  }
  bool get(void* bytes, std::size_t size) {
    auto* at = static_cast<char*>(bytes);
    while (size > 0) {
      const ssize_t got = ::read(pipe_, at, size);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got, size -= static_cast<std::size_t>(got);
    }
    return true;
  }

 private:
  int pipe_;
};

void limit(std::uint64_t file_size) {
  constexpr std::uint64_t kMemory = 512U << 20, kMiB = 1U << 20, kSeconds = 60;
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const std::uint64_t now = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const std::uint64_t memory = now + mostColumnBytes(file_size) + kMemory;
  const std::uint64_t seconds = kSeconds + file_size / kMiB;
  const rlimit space{memory, memory}, time{seconds, seconds}, none{0, 0};
  ::setrlimit(RLIMIT_AS, &space);
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &none);
}

/// In the new process: reads, and sends every column.
[[noreturn]] void work(int pipe, std::uint64_t file_size, const ColumnTarget& target,
                       const std::function<void(const ColumnTarget& target)>& read) {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDERR_FILENO);  // what the C library says of memory that is not its own
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
  limit(file_size);
  Sender sender(pipe);
  std::vector<double>* column = nullptr;
  const auto finish = [&] {
    if (!column) return;
    sender.put(Message::kValues);
    sender.put(std::uint64_t{column->size()});
    sender.put(column->data(), column->size() * sizeof(double));
    *column = {};
    column = nullptr;
  };
  try {
    read([&](std::string_view name, std::size_t index) {
      finish();
      sender.put(Message::kColumn);
      sender.put(std::string(name));
      sender.put(std::uint64_t{index});
      return column = target(name, index);
    });
    finish();
    sender.put(Message::kEnd);
  } catch (const base::InputError& error) {
    const base::InputFault& fault = error.fault();
    sender.put(Message::kError);
    for (const std::string* part : {&fault.file, &fault.key, &fault.value, &fault.reason, &fault.remedy})
      sender.put(*part);
    sender.put(static_cast<std::uint64_t>(fault.line));
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// Takes the columns. False: the process ended before it was ready.
bool take(int pipe, std::uint64_t most, const ColumnTarget& target) {
  Receiver receiver(pipe);
  std::vector<double>* column = nullptr;
  for (Message kind{}; receiver.get(kind);) {
    if (kind == Message::kEnd) return true;
    if (kind == Message::kColumn) {
      std::string name;
      std::uint64_t index = 0;
      if (!receiver.get(name) || !receiver.get(index)) return false;
      column = target(name, index);
    } else if (kind == Message::kValues) {
      std::uint64_t rows = 0;
      if (!column || !receiver.get(rows) || rows > most / sizeof(double)) return false;
      column->resize(rows);
      if (!receiver.get(column->data(), rows * sizeof(double))) return false;
    } else if (kind == Message::kError) {
      base::InputFault fault;
      std::uint64_t line = 0;
      for (std::string* part : {&fault.file, &fault.key, &fault.value, &fault.reason, &fault.remedy})
        if (!receiver.get(*part)) return false;
      if (!receiver.get(line)) return false;
      fault.line = static_cast<int>(line);
      throw base::InputError(std::move(fault));
    } else {
      return false;
    }
  }
  return false;
}

/// The new process, ended at the latest with this object.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

 private:
  pid_t id_;
};

/// Both ends of a pipe.
struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() {
    if (::pipe2(ends, O_CLOEXEC) != 0) ends[0] = ends[1] = -1;
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() { closeEnd(0), closeEnd(1); }
  void closeEnd(int which) {
    if (ends[which] >= 0) ::close(ends[which]);
    ends[which] = -1;
  }
};

}  // namespace

void readInProcess(const std::filesystem::path& path, const ColumnTarget& target,
                   const std::function<void(const ColumnTarget& target)>& read) {
  std::error_code fault;
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  const std::uint64_t file_size = fault ? 0 : size;
  Pipe pipe;
  pid_t id = -1;
  if (pipe.ends[0] >= 0) {
    const Hdf5Lock lock;  // no other thread is within HDF5 while the process is copied
    id = ::fork();
    if (id == 0) work(pipe.ends[1], file_size, target, read);
  }
  if (id < 0)
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            "cannot be read: no process can be started for it",
                            "Close other programs"});
  pipe.closeEnd(1);
  const Child child(id);
  if (!take(pipe.ends[0], mostColumnBytes(file_size), target))
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            "is damaged: HDF5 cannot read it",
                            "Restore it from a copy, or write it again"});
}

}  // namespace capstan::table_files
