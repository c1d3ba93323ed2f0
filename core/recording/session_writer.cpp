#include "core/recording/session_writer.h"

#include <fmt/format.h>
#include <time.h>

#include <charconv>

#include "core/base/error.h"
#include "core/base/rigid.h"
#include "core/recording/row_counts.h"
#include "core/recording/schema.h"

namespace capstan::recording {
namespace {

constexpr int kGrowth = 1 << 20;  ///< step by which the main file grows [bytes]

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Database createDatabase(const std::filesystem::path& path, SessionWriter::Durability durability) {
  const std::string remedy = "Choose another name, or a folder that exists and can be written";
  if (std::filesystem::exists(path))
    throw base::InputError({path.string(), 0, {}, {}, "exists already", remedy});
  try {
    Database database(path, Database::Mode::kCreate);
    database.run(fmt::format("PRAGMA page_size = {}; PRAGMA application_id = {}; PRAGMA user_version = {};",
                             kPageSize, kApplicationId, kSchemaVersion));
    database.run("PRAGMA cache_size = -32768; PRAGMA temp_store = MEMORY;");
    database.run(durability == SessionWriter::Durability::kFast
                     ? "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0;"
                     : "PRAGMA synchronous = OFF;");
    return database;
  } catch (const SqliteError& error) {
    throw base::InputError(
        {path.string(), 0, {}, {}, fmt::format("cannot be created: {}", error.what()), remedy});
  }
}

void writeDictionary(Database& database) {
  Statement insert(database, insertStatement(dictionaryTable()));
  const auto write = [&](std::string_view table_name, const Column& column) {
    insert.bind(1, table_name);
    insert.bind(2, column.name);
    insert.bind(3, column.unit);
    insert.bind(4, column.meaning);
    insert.execute();
  };
  for (const Table& table : tables()) {
    write(table.name, {"", ColumnType::kText, "", table.meaning});
    for (const Column& column : table.columns) write(table.name, column);
    write(table.name, kCheck);
  }
}

/// Waits until earlier commits are on the disk. `which`: SQLITE_FCNTL_FILE_POINTER, or
/// SQLITE_FCNTL_JOURNAL_POINTER for the log.
void sync(Database& database, int which) {
  sqlite3_file* file = nullptr;
  sqlite3_file_control(database.handle(), nullptr, which, &file);
  if (file && file->pMethods) file->pMethods->xSync(file, SQLITE_SYNC_NORMAL);
}

/// Makes the main file grow by multiples of `bytes`; 0: by its content.
void growBy(Database& database, int bytes) {
  sqlite3_file_control(database.handle(), nullptr, SQLITE_FCNTL_CHUNK_SIZE, &bytes);
}

bool hasLog(const std::filesystem::path& path) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(path.string() + "-wal", fault);
  return !fault && size > 0;
}

void bindVector(Statement& statement, int& index, const Eigen::Vector3d& value) {
  for (int i = 0; i < 3; ++i) statement.bind(index++, value(i));
}

}  // namespace

SessionWriter::SessionWriter(const std::filesystem::path& path, const SessionHeader& header,
                             Durability durability)
    : database_(createDatabase(path, durability)) {
  try {
    begin();
    for (const Table& table : tables()) database_.run(createStatement(table));
    writeDictionary(database_);
    put("title", header.title);
    put("created", header.created);
    put("software", header.software);
    put("robot", header.robot);
    put("camera_left", header.camera_left);
    put("camera_right", header.camera_right);
    put("truth", header.truth);
    put("marker", header.marker);
    put("tracking", header.tracking);
    put("reference", header.own_kinematics ? kOwnKinematics : std::string_view(header.reference ? "1" : "0"));
    if (header.base_from_camera) setRegistration(*header.base_from_camera);
    commit();
    for (int which = 0; which < kSampleTables; ++which)
      insert_[static_cast<std::size_t>(which)] =
          std::make_unique<Statement>(database_, insertStatement(table(static_cast<SampleTable>(which))));
    if (durability != Durability::kFast) return;
    database_.run("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA synchronous = OFF;");
    page_count_ = std::make_unique<Statement>(database_, "PRAGMA page_count");
    growBy(database_, kGrowth);
  } catch (const SqliteError& error) {
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            fmt::format("cannot be written: {}", error.what()),
                            "Check the folder, its permissions and the space"});
  }
}

void SessionWriter::begin() { database_.run("BEGIN IMMEDIATE"); }
void SessionWriter::commit() {
  if (page_count_) makeRoom();
  database_.run("COMMIT");
}

/// Reserves room in the main file. SQLite writes into every block of it, so that the file system keeps it
/// allocated.
void SessionWriter::makeRoom() {
  page_count_->step();
  sqlite3_int64 bytes = page_count_->integer(0) * kPageSize;
  page_count_->reset();
  const int code =
      sqlite3_file_control(database_.handle(), nullptr, SQLITE_FCNTL_SIZE_HINT, static_cast<void*>(&bytes));
  if (code != SQLITE_OK) throw SqliteError(SQLITE_FULL, "the disk has no room for the file to grow");
  file_bytes_ = static_cast<std::uint64_t>(bytes);
}
void SessionWriter::rollback() noexcept {
  sqlite3_exec(database_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void SessionWriter::write(std::int64_t seq, const tracking::MotorSample& sample) {
  Statement& insert = *insert_[kMotorTable];
  insert.bind(1, seq);
  insert.bind(2, sample.t);
  int index = 3;
  bindVector(insert, index, sample.position);
  bindVector(insert, index, sample.velocity);
  bindVector(insert, index, sample.torque);
  insert.execute();
  row_bytes_ += 11 * sizeof(double);
}

void SessionWriter::write(std::int64_t seq, const tracking::JointSample& sample) {
  Statement& insert = *insert_[kJointTable];
  insert.bind(1, seq);
  insert.bind(2, sample.t);
  int index = 3;
  bindVector(insert, index, sample.position);
  insert.execute();
  row_bytes_ += 5 * sizeof(double);
}

void SessionWriter::write(std::int64_t seq, const tracking::TipSample& sample) {
  Statement& insert = *insert_[kTipTable];
  insert.bind(1, seq);
  insert.bind(2, sample.t);
  insert.bind(3, sample.t_arrival);
  int index = 4;
  bindVector(insert, index, sample.position);
  insert.execute();
  row_bytes_ += 6 * sizeof(double);
}

void SessionWriter::write(std::int64_t seq, const tracking::StereoFrame& frame) {
  const cv::Mat& any = frame.left.empty() ? frame.right : frame.left;
  Statement& insert = *insert_[kFrameTable];
  insert.bind(1, seq);
  insert.bind(2, frame.t);
  insert.bind(3, frame.t_arrival);
  insert.bind(5, std::int64_t{any.cols});
  insert.bind(6, std::int64_t{any.rows});
  for (const int index : {4, 7, 8}) insert.bindNull(index);
  if (!frame.left.empty() && !frame.right.empty() && frame.left.size != frame.right.size)
    throw SqliteError(SQLITE_MISUSE, "the two images of a pair differ in size");
  if (!any.empty()) {
    SizedEncoders& encoders = encodersFor(any.cols, any.rows);
    insert.bind(4, encoders.codec);
    insert.bind(7, pack(encoders.left, frame.left));
    insert.bind(8, pack(encoders.right, frame.right));
  }
  insert.execute();
  row_bytes_ += 6 * sizeof(double);
}

void SessionWriter::write(std::int64_t seq, const EstimateRow& row) {
  Statement& insert = *insert_[kEstimateTable];
  insert.bind(1, seq);
  insert.bind(2, row.t);
  insert.bind(3, row.t_cam);
  int index = 4;
  for (const Eigen::Vector3d* value :
       {&row.q_link_kin, &row.q_link_cam, &row.q_link_cam_sigma, &row.q_link_ukf, &row.dq_link_ukf,
        &row.q_link_ukf_sigma, &row.q_link_true})
    bindVector(insert, index, *value);
  insert.bind(index++, std::int64_t{row.gate});
  insert.bind(index++, std::int64_t{row.camera_updated});
  insert.bind(index++, row.nis);
  insert.bind(index++, row.nees);
  insert.execute();
  row_bytes_ += 28 * sizeof(double);
}

void SessionWriter::write(std::int64_t seq, const SessionEvent& event) {
  Statement& insert = *insert_[kEventTable];
  insert.bind(1, seq);
  insert.bind(2, event.t);
  insert.bind(3, event.kind);
  insert.bind(4, event.text);
  insert.execute();
  row_bytes_ += 2 * sizeof(double) + event.kind.size() + event.text.size();
}

void SessionWriter::setRegistration(const Eigen::Isometry3d& base_from_camera) {
  put("registration", formatPose(base_from_camera));
}

void SessionWriter::setMarker(const std::string& marker) { put("marker", marker); }
void SessionWriter::setRobot(const std::string& robot) { put("robot", robot); }

bool SessionWriter::finish() {
  constexpr int kPatience = 200;  // [ms]; the log stays if a reader's transaction takes longer
  insert_ = {};
  page_count_.reset();
  sqlite3_busy_timeout(database_.handle(), kPatience);
  putRows();
  database_.run("PRAGMA synchronous = NORMAL");
  growBy(database_, 0);
  sqlite3_wal_checkpoint_v2(database_.handle(), nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  try {
    database_.run("PRAGMA journal_mode = DELETE");
    sync(database_, SQLITE_FCNTL_FILE_POINTER);
    return true;
  } catch (const SqliteError& error) {
    if (error.code() == SQLITE_BUSY) {
      sync(database_, SQLITE_FCNTL_JOURNAL_POINTER);  // a reader uses the log
      return false;
    }
    if (hasLog(sqlite3_db_filename(database_.handle(), nullptr))) throw;
  }
  database_.run("PRAGMA journal_mode = MEMORY");  // the log is in the file; there was no space for a journal
  return true;
}

SessionWriter::SizedEncoders& SessionWriter::encodersFor(int width, int height) {
  for (SizedEncoders& encoders : encoders_)
    if (encoders.width == width && encoders.height == height) return encoders;
  const auto id = static_cast<std::int64_t>(encoders_.size()) + 1;
  encoders_.push_back({width, height, id, FrameEncoder(width, height), FrameEncoder(width, height)});
  const CodecParameters& parameters = encoders_.back().left.parameters();
  Statement insert(database_, insertStatement(codecTable(), "INSERT OR REPLACE"));
  bindCodec(insert, id, parameters);
  insert.execute();
  return encoders_.back();
}

std::span<const std::uint8_t> SessionWriter::pack(FrameEncoder& encoder, const cv::Mat& image) {
  if (image.empty()) return {};
  const double begin = threadSeconds();
  const auto packet = encoder.encode(image);
  encode_seconds_ += threadSeconds() - begin;
  ++images_;
  row_bytes_ += packet.size();
  return packet;
}

/// Writes the numbers of rows, so that a reader notices when rows have vanished. On a full disk it leaves
/// them out.
void SessionWriter::putRows() {
  try {
    put("rows", textOf(rowCounts(database_)));
  } catch (const SqliteError& error) {
    if (error.code() != SQLITE_FULL && error.code() != SQLITE_IOERR) throw;
  }
}

void SessionWriter::put(std::string_view key, std::string_view value) {
  Statement insert(database_, insertStatement(headerTable(), "INSERT OR REPLACE"));
  insert.bind(1, key);
  insert.bind(2, value);
  insert.execute();
}

void bindCodec(Statement& insert, std::int64_t id, const CodecParameters& parameters) {
  insert.bind(1, id);
  insert.bind(2, parameters.name);
  insert.bind(3, std::int64_t{parameters.width});
  insert.bind(4, std::int64_t{parameters.height});
  insert.bind(5, std::int64_t{parameters.fourcc});
  insert.bind(6, std::span<const std::uint8_t>(parameters.extradata));
}

void foldLog(const std::filesystem::path& session) {
  std::error_code fault;
  if (!std::filesystem::exists(session.string() + "-wal", fault)) return;
  try {
    Database(session, Database::Mode::kReadWrite).run("PRAGMA journal_mode = DELETE");
  } catch (const SqliteError& error) {
    if (error.code() == SQLITE_BUSY)
      throw base::InputError(
          {session.string(), 0, {}, {}, "is in use", "Close the program that records or shows it"});
  }
  for (const char* suffix : {"-wal", "-shm"}) std::filesystem::remove(session.string() + suffix, fault);
}

std::string formatPose(const Eigen::Isometry3d& pose) {
  std::string text;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      text += fmt::format("{}{}", text.empty() ? "" : " ", pose.matrix()(row, column));
  return text;
}

std::optional<Eigen::Isometry3d> parsePose(std::string_view text) {
  Eigen::Isometry3d pose;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (int i = 0; i < 16; ++i) {
    while (at != end && *at == ' ') ++at;
    const auto [next, fault] = std::from_chars(at, end, pose.matrix()(i / 4, i % 4));
    if (fault != std::errc()) return std::nullopt;
    at = next;
  }
  if (!base::isRigid(pose.matrix())) return std::nullopt;
  return pose;
}

}  // namespace capstan::recording
