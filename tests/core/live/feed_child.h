/// Processes of their own for tests of the monitor feed.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <string>

namespace capstan::live::testing {

/// Runs `body` in a process of its own, which is killed at the latest by the destructor. The constructor
/// returns once `body` has called its argument.
class Child {
 public:
  explicit Child(const std::function<void(const std::function<void()>&)>& body) {
    int ends[2];
    if (pipe(ends) != 0) return;
    process_ = fork();
    if (process_ == 0) {
      body([&] { (void)!write(ends[1], "!", 1); });
      _exit(0);
    }
    char ready = 0;
    close(ends[1]);
    (void)!read(ends[0], &ready, 1);
    close(ends[0]);
  }
  ~Child() { kill(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void send(int signal) const { ::kill(process_, signal); }
  /// As `kill -9`; returns once the process has gone.
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

/// Name of a feed that no other test process uses.
inline std::string feedNamed(const std::string& name) { return name + "-" + std::to_string(getpid()); }

}  // namespace capstan::live::testing
