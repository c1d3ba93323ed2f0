#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "core/base/progress.h"

namespace capstan::widgets {

/// Runs background work: at most one piece at a time, on its own thread with low priority, so that images and
/// plots have precedence. The result is delivered on the window's thread, unless the work was cancelled. The
/// destructor cancels the work and waits for its thread.
class Job : public QObject {
  Q_OBJECT

 public:
  explicit Job(QObject* parent = nullptr);
  ~Job() override;

  /// Runs `work(progress)` in the background, then `done(result)` on this thread. Only if not busy().
  /// Exceptions of `work` are reported by failed().
  template <class Work, class Done>
  void start(Work work, Done done) {
    using Result = std::invoke_result_t<Work&, base::Progress&>;
    auto result = std::make_shared<std::unique_ptr<Result>>();
    run([work = std::move(work),
         result](base::Progress& progress) mutable { *result = std::make_unique<Result>(work(progress)); },
        [done = std::move(done), result]() mutable { done(std::move(**result)); });
  }

  /// Requests that the work ends, and drops its result. busy() is true until it has ended.
  void cancel();
  bool busy() const { return task_ != nullptr; }

 signals:
  /// Emitted about ten times per second while work is running: share done, 0…1, and the present activity.
  void progressed(double fraction, const QString& doing);
  void failed(const QString& why);
  /// The thread has ended, with any result; emitted after done and failed().
  void ended();

 private:
  struct Task;
  void run(std::function<void(base::Progress&)> work, std::function<void()> done);
  void finish();

  std::shared_ptr<Task> task_;
  QTimer ticks_;
};

}  // namespace capstan::widgets
