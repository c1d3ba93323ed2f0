#include "app/workstation/closing_signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <QApplication>
#include <QSocketNotifier>
#include <QVariant>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "widgets/shell/unsaved_poses.h"

namespace capstan::workstation {
namespace {

int pipe_ends[2] = {-1, -1};

/// A handler may only call functions that are safe in signal handlers: it leaves the work to the event loop.
void wakeEventLoop(int signal) {
  const int before = errno;
  std::signal(signal, SIG_DFL);
  [[maybe_unused]] const auto written = write(pipe_ends[1], "", 1);
  errno = before;
}

}  // namespace

void closeOnSignals(QCoreApplication& application) {
  if (pipe2(pipe_ends, O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::system_error(errno, std::generic_category(), "pipe for signals");
  auto* notifier = new QSocketNotifier(pipe_ends[0], QSocketNotifier::Read, &application);
  QObject::connect(notifier, &QSocketNotifier::activated, &application, [notifier] {
    notifier->setEnabled(false);
    QCoreApplication::instance()->setProperty(widgets::kUnattended, true);
    QApplication::closeAllWindows();
    QApplication::quit();
  });
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) std::signal(signal, wakeEventLoop);
}

}  // namespace capstan::workstation
