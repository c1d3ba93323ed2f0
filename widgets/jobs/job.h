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

/// One place for background work: at most one piece at a time, on a thread of its own and at low priority, so
/// that pictures and plots come first. Its result reaches the window's thread, unless it was cancelled. The
/// destructor cancels and waits for the thread.
class Job : public QObject {
  Q_OBJECT

 public:
  explicit Job(QObject* parent = nullptr);
  ~Job() override;

  /// Runs `work(progress)` in the background, then `done(result)` here. Only if not busy(). What `work`
  /// throws comes as failed().
  template <class Work, class Done>
  void start(Work work, Done done) {
    using Result = std::invoke_result_t<Work&, base::Progress&>;
    auto result = std::make_shared<std::unique_ptr<Result>>();
    run([work = std::move(work),
         result](base::Progress& progress) mutable { *result = std::make_unique<Result>(work(progress)); },
        [done = std::move(done), result]() mutable { done(std::move(**result)); });
  }

  /// Asks the work to end and drops its result. It is busy() until it has ended.
  void cancel();
  bool busy() const { return task_ != nullptr; }

 signals:
  /// About ten times a second while work is under way: share done, 0…1, and what is being done.
  void progressed(double fraction, const QString& doing);
  void failed(const QString& why);
  /// The thread has ended, whatever came of it; behind done and failed().
  void ended();

 private:
  struct Task;
  void run(std::function<void(base::Progress&)> work, std::function<void()> done);
  void finish();

  std::shared_ptr<Task> task_;
  QTimer ticks_;
};

}  // namespace capstan::widgets
