#include "core/recording/checkpointer.h"

#include <fcntl.h>
#include <unistd.h>

namespace capstan::recording {
namespace {

constexpr int kPasses = 8;  // each pass copies the commits during the previous pass; passes get shorter

int keepLength(sqlite3_file*, sqlite3_int64) { return SQLITE_OK; }

}  // namespace

Checkpointer::Checkpointer(const std::filesystem::path& path, std::uint64_t threshold)
    : path_(path), threshold_(threshold), thread_([this] { work(); }) {}

Checkpointer::~Checkpointer() { stop(); }

void Checkpointer::watch(Database& writer) {
  page_bytes_ = static_cast<std::uint64_t>(writer.number("PRAGMA page_size"));
  sqlite3_wal_hook(writer.handle(), &Checkpointer::onCommit, this);
}

int Checkpointer::onCommit(void* self, sqlite3*, const char*, int pages) {
  auto& checkpointer = *static_cast<Checkpointer*>(self);
  const auto length = static_cast<std::uint64_t>(pages);
  if (length < checkpointer.pages_.exchange(length)) checkpointer.restarted_ = true;
  return SQLITE_OK;
}

void Checkpointer::wake() {
  if (!restarted_ && logBytes() < threshold_) return;
  {
    const std::lock_guard lock(mutex_);
    due_ = true;
  }
  wake_.notify_one();
}

void Checkpointer::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Checkpointer::work() {
  std::unique_ptr<Database> database;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return due_ || stopping_; });
      if (stopping_) return;
      due_ = false;
    }
    try {
      if (restarted_.exchange(false)) syncLog();
      if (!database) {
        database = std::make_unique<Database>(path_, Database::Mode::kReadWrite);
        database->run("PRAGMA synchronous = NORMAL");
        keepLengthOf(*database);
      }
      if (logBytes() >= threshold_) checkpoint(*database);
    } catch (const SqliteError&) {
      database.reset();  // the log only grows; the writer reports what stops it
    }
  }
}

void Checkpointer::keepLengthOf(Database& database) {
  sqlite3_file* file = nullptr;
  sqlite3_file_control(database.handle(), nullptr, SQLITE_FCNTL_FILE_POINTER, &file);
  if (!file || !file->pMethods || file->pMethods == &methods_) return;
  methods_ = *file->pMethods;
  methods_.xTruncate = keepLength;
  file->pMethods = &methods_;
}

void Checkpointer::checkpoint(Database& database) {
  for (int pass = 0; pass < kPasses; ++pass) {
    int length = 0, copied = 0;
    const int code =
        sqlite3_wal_checkpoint_v2(database.handle(), nullptr, SQLITE_CHECKPOINT_PASSIVE, &length, &copied);
    if (code != SQLITE_OK) return;
    const bool caught_up = static_cast<std::uint64_t>(copied) >= pages_.load(std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    if (caught_up || stopping_) return;
  }
}

void Checkpointer::syncLog() {
  const int file = ::open((path_.string() + "-wal").c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  ::fdatasync(file);
  ::close(file);
}

}  // namespace capstan::recording
