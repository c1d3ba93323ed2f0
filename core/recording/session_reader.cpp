#include "core/recording/session_reader.h"

#include <fmt/format.h>
#include <unistd.h>

#include "core/recording/session_writer.h"

namespace capstan::recording {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason,
                         const std::string& remedy) {
  throw base::InputError({path.string(), 0, {}, {}, reason, remedy});
}

/// Whether a file that is no database may be a session whose beginning is damaged.
bool mayBeDamaged(const std::filesystem::path& path) {
  std::error_code fault;
  return path.extension() == kSessionSuffix && std::filesystem::file_size(path, fault) > kPageSize && !fault;
}

base::InputError notASession(const std::filesystem::path& path) {
  return base::InputError({path.string(),
                           0,
                           {},
                           {},
                           "is not a session file: it is no SQLite 3 database",
                           mayBeDamaged(path)
                               ? kRecoverRemedy
                               : fmt::format("Choose a file recorded by Capstan (*{})", kSessionSuffix)});
}

/// Checks the file without opening it. Closing it would release all locks of this process on the file, also
/// those of a recorder (POSIX; SQLite, How To Corrupt, 2.2).
void checkFile(const std::filesystem::path& path) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault)) refuse(path, "is not a file", "Check the path");
  if (::access(path.c_str(), R_OK) != 0) refuse(path, "cannot be opened", "Check its permissions");
  if (std::filesystem::file_size(path, fault) == 0) throw notASession(path);  // to SQLite a new database
}

void checkIdentity(Database& database, const std::filesystem::path& path) {
  const std::int64_t application = database.number("PRAGMA application_id");
  if (application != kApplicationId)
    refuse(path, "is an SQLite database of another program",
           fmt::format("Choose a file recorded by Capstan (*{})", kSessionSuffix));
  const std::int64_t version = database.number("PRAGMA user_version");
  if (version > kSchemaVersion)
    refuse(path, fmt::format("has schema version {}, this program knows up to {}", version, kSchemaVersion),
           "Open it with a newer Capstan");
  for (const Table& table : tables()) {
    if (!database.hasTable(table.name))
      refuse(path, fmt::format("lacks the table {}", table.name), kRecoverRemedy);
    if (database.hasComputedColumns(table.name))
      refuse(path, fmt::format("has columns that are computed in the table {}", table.name), kRecoverRemedy);
  }
}

/// `file:` URI of `path` as an immutable file, for which SQLite needs neither locks nor additional files.
std::string immutableUri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string())
    uri += (c == '?' || c == '#' || c == '%') ? fmt::format("%{:02x}", static_cast<unsigned char>(c))
                                              : std::string(1, c);
  return uri + "?immutable=1";
}

}  // namespace

Database openSession(const std::filesystem::path& path) {
  checkFile(path);
  try {
    Database database(path, Database::Mode::kRead);
    try {
      checkIdentity(database, path);
      return database;
    } catch (const SqliteError& error) {
      const std::filesystem::path log = path.string() + "-wal";
      if (error.code() != SQLITE_CANTOPEN || std::filesystem::exists(log)) throw;
    }
    Database still(immutableUri(path), Database::Mode::kReadUri);
    checkIdentity(still, path);
    return still;
  } catch (const SqliteError& error) {
    throw damagedSession(path, error);
  }
}

base::InputError damagedSession(const std::filesystem::path& path, const SqliteError& error) {
  if (error.code() == SQLITE_CANTOPEN || error.code() == SQLITE_READONLY)
    return base::InputError(
        {path.string(),
         0,
         {},
         {},
         fmt::format("cannot be opened: {}", error.what()),
         "Copy it, with the files of the same name beside it, to a folder that can be written"});
  if (error.code() == SQLITE_NOTADB) return notASession(path);
  if (error.code() == SQLITE_BUSY)
    return base::InputError({path.string(), 0, {}, {}, "is locked by another program", "Close that program"});
  return base::InputError(
      {path.string(), 0, {}, {}, fmt::format("is damaged: {}", error.what()), kRecoverRemedy});
}

bool hasChecks(Database& database) {
  return database.number("SELECT count(*) FROM pragma_table_info('motor') WHERE name = 'crc'") == 1;
}

Statement rowsOf(Database& database, const Table& table, std::string_view rest) {
  return {database, fmt::format("{} {}", selectStatement(table, hasChecks(database)), rest)};
}

SessionHeader readHeader(Database& database) {
  std::map<std::string, std::string> value;
  Statement rows = rowsOf(database, headerTable(), "");
  while (rows.step()) value[rows.text(0)] = rows.text(1);

  SessionHeader header;
  header.title = value["title"];
  header.created = value["created"];
  header.software = value["software"];
  header.robot = value["robot"];
  header.camera_left = value["camera_left"];
  header.camera_right = value["camera_right"];
  header.truth = value["truth"];
  header.marker = value["marker"];
  header.tracking = value["tracking"];
  header.own_kinematics = value["reference"] == kOwnKinematics;
  header.reference = value["reference"] == "1" || header.own_kinematics;
  header.base_from_camera = parsePose(value["registration"]);
  if (!header.base_from_camera && !value["registration"].empty())
    throw SqliteError(SQLITE_CORRUPT, "the registration in its header is no rigid transform");
  header.rows = value["rows"];
  return header;
}

std::map<std::int64_t, FrameDecoder> readCodecs(Database& database, const std::string& file) {
  std::map<std::int64_t, FrameDecoder> codecs;
  Statement rows = rowsOf(database, codecTable(), "");
  while (rows.step()) {
    if (!isFrameSize(rows.integer(2), rows.integer(3)) || codecs.size() == kMostCodecs)
      throw SqliteError(SQLITE_CORRUPT, "its table codec has an impossible size of images, or too many rows");
    const auto extradata = rows.blob(5);
    const CodecParameters parameters = {rows.text(1),
                                        static_cast<int>(rows.integer(2)),
                                        static_cast<int>(rows.integer(3)),
                                        {extradata.begin(), extradata.end()},
                                        static_cast<std::uint32_t>(rows.integer(4))};
    codecs.emplace(rows.integer(0), FrameDecoder(parameters, file));
  }
  return codecs;
}

}  // namespace capstan::recording
