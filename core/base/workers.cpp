#include "core/base/workers.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>

namespace capstan::base {
namespace {

/// State that the jobs share with the thread that watches them.
struct Board {
  Board(const std::vector<Job>& jobs, int threads)
      : order(jobs.size()), progress(jobs.size()), faults(jobs.size()), state(jobs.size()) {
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (threads > 1)
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return jobs[a].weight > jobs[b].weight; });
    for (auto& one : progress) one = std::make_unique<base::Progress>();
  }

  void cancelAll() {
    cancelled = true;
    for (auto& one : progress) one->cancel();
  }

  enum class State { kWaiting, kRunning, kDone };
  std::vector<std::size_t> order;
  std::vector<std::unique_ptr<base::Progress>> progress;
  std::vector<std::exception_ptr> faults;
  std::vector<std::atomic<State>> state;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> cancelled{false};
  std::mutex mutex;
  std::condition_variable finished;
  std::size_t workers = 0;
};

void work(const std::vector<Job>& jobs, Board& board) {
  for (;;) {
    const std::size_t turn = board.next++;
    if (turn >= jobs.size() || board.cancelled) break;
    const std::size_t i = board.order[turn];
    board.state[i] = Board::State::kRunning;
    try {
      jobs[i].work(*board.progress[i]);
    } catch (...) {
      board.faults[i] = std::current_exception();
      board.cancelAll();
    }
    board.state[i] = Board::State::kDone;
  }
  const std::lock_guard lock(board.mutex);
  --board.workers;
  board.finished.notify_all();
}

void show(const std::vector<Job>& jobs, const Board& board, const ProgressSlice& progress) {
  double done = 0.0, total = 0.0;
  std::string running;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const Board::State state = board.state[i];
    total += jobs[i].weight;
    if (state == Board::State::kDone) done += jobs[i].weight;
    if (state != Board::State::kRunning) continue;
    done += jobs[i].weight * board.progress[i]->fraction();
    const std::string doing = board.progress[i]->doing();
    running += (running.empty() ? "" : ", ") + jobs[i].name + (doing.empty() ? "" : ": " + doing);
  }
  progress.report(total > 0.0 ? done / total : 1.0, running);
}

}  // namespace

void doAll(const std::vector<Job>& jobs, int threads, const ProgressSlice& progress) {
  Board board(jobs, threads);
  board.workers = std::min(static_cast<std::size_t>(std::max(threads, 1)), jobs.size());
  {
    std::vector<std::jthread> pool;
    for (std::size_t i = 0, count = board.workers; i < count; ++i)
      pool.emplace_back([&] { work(jobs, board); });
    std::unique_lock lock(board.mutex);
    while (
        !board.finished.wait_for(lock, std::chrono::milliseconds(50), [&] { return board.workers == 0; })) {
      if (progress.whole.cancelled() && !board.cancelled) board.cancelAll();
      show(jobs, board, progress);
    }
  }
  for (const std::exception_ptr& fault : board.faults)
    if (fault) std::rethrow_exception(fault);
}

}  // namespace capstan::base
