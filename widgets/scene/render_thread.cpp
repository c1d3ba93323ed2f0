#include "widgets/scene/render_thread.h"

#include <sys/resource.h>
#include <unistd.h>

#include <QObject>
#include <QThread>
#include <utility>

namespace capstan::widgets {
namespace {

constexpr int kNiceness = 10;  ///< the software renderer's threads inherit it: data come first

/// An object whose queued calls run in the thread. Both last to the end of the process.
class Worker {
 public:
  Worker() {
    thread_.setObjectName("scene");
    home_.moveToThread(&thread_);
    thread_.start();
    call([] { ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness); }, Qt::QueuedConnection);
  }
  ~Worker() {
    thread_.quit();
    thread_.wait();
  }
  void call(std::function<void()> task, Qt::ConnectionType how) {
    QMetaObject::invokeMethod(&home_, std::move(task), how);
  }

 private:
  QThread thread_;
  QObject home_;
};

Worker& worker() {
  static Worker worker;
  return worker;
}

}  // namespace

void RenderThread::post(std::function<void()> task) { worker().call(std::move(task), Qt::QueuedConnection); }
void RenderThread::run(std::function<void()> task) {
  worker().call(std::move(task), Qt::BlockingQueuedConnection);
}

}  // namespace capstan::widgets
