#include "widgets/jobs/job.h"

#include <QMetaObject>
#include <exception>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace capstan::widgets {

namespace {

constexpr int kPeriod = 100;  ///< period of progressed() [ms]

/// Lowers the priority of the calling thread; without effect where the system does not support it.
void lowerPriority() {
#ifdef __linux__
  constexpr int kNice = 10;
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
#endif
}

}  // namespace

struct Job::Task {
  base::Progress progress;
  std::function<void()> done;
  std::string fault;
  std::thread thread;
};

Job::Job(QObject* parent) : QObject(parent) {
  ticks_.setInterval(kPeriod);
  connect(&ticks_, &QTimer::timeout, this, [this] {
    if (task_ && !task_->progress.cancelled())
      Q_EMIT progressed(task_->progress.fraction(), QString::fromStdString(task_->progress.doing()));
  });
}

Job::~Job() {
  cancel();
  if (task_) task_->thread.join();
}

void Job::run(std::function<void(base::Progress&)> work, std::function<void()> done) {
  Q_ASSERT(!busy());
  task_ = std::make_shared<Task>();
  task_->done = std::move(done);
  task_->thread = std::thread([this, task = task_.get(), work = std::move(work)] {
    lowerPriority();
    try {
      work(task->progress);
    } catch (const std::exception& error) {
      task->fault = error.what();
    }
    QMetaObject::invokeMethod(this, &Job::finish, Qt::QueuedConnection);
  });
  ticks_.start();
}

void Job::cancel() {
  if (task_) task_->progress.cancel();
}

void Job::finish() {
  ticks_.stop();
  const auto task = std::exchange(task_, nullptr);
  task->thread.join();
  if (!task->progress.cancelled()) {
    if (task->fault.empty())
      task->done();
    else
      Q_EMIT failed(QString::fromStdString(task->fault));
  }
  Q_EMIT ended();
}

}  // namespace capstan::widgets
