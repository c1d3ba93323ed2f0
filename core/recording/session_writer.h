#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/recording/frame_codec.h"
#include "core/recording/session_file.h"
#include "core/recording/sqlite.h"
#include "core/tracking/sample.h"

namespace capstan::recording {

/// Writes the rows of a session file. One thread only; every call may wait for the disk. Every `seq` may be
/// used once.
class SessionWriter {
 public:
  /// Durability of commits. kFast: a commit reaches the operating system and survives a crash of the process.
  /// If another thread checkpoints, a loss of power leaves a consistent file that ends earlier. kPlain: a
  /// rollback journal, for imports; the data are on the disk when finish() returns.
  enum class Durability { kFast, kPlain };

  /// Creates `path`. Throws base::InputError when the file exists or cannot be created.
  SessionWriter(const std::filesystem::path& path, const SessionHeader& header, Durability durability);

  // All of these throw SqliteError.
  void begin();
  /// Commits the transaction. With kFast, room for every page is first reserved in the main file, so that the
  /// log can always be moved there, even on a full disk. SQLITE_FULL: there was no room; roll back.
  void commit();
  void rollback() noexcept;

  void write(std::int64_t seq, const tracking::MotorSample& sample);
  void write(std::int64_t seq, const tracking::JointSample& sample);
  void write(std::int64_t seq, const tracking::TipSample& sample);
  /// Encodes and writes a frame; an empty image becomes NULL. Both images must have the same size.
  void write(std::int64_t seq, const tracking::StereoFrame& frame);
  void write(std::int64_t seq, const EstimateRow& row);
  void write(std::int64_t seq, const SessionEvent& event);
  void setRegistration(const Eigen::Isometry3d& base_from_camera);
  void setMarker(const std::string& marker);
  void setRobot(const std::string& robot);

  /// Moves the write-ahead log into the file and deletes the log; this needs no space on the disk. True: the
  /// session is now a single file. False: another connection reads the session, and the complete log stays
  /// beside it on the disk.
  bool finish();

  Database& database() { return database_; }
  std::uint64_t rowBytes() const { return row_bytes_; }     ///< payload written so far
  std::uint64_t fileBytes() const { return file_bytes_; }   ///< size of the file at the last commit
  double encodeSeconds() const { return encode_seconds_; }  ///< processor time of all encoding [s]
  std::int64_t images() const { return images_; }           ///< number of images encoded so far

 private:
  /// Encoders of one image size; one per side, because a packet is valid only until the next one.
  struct SizedEncoders {
    int width, height;
    std::int64_t codec;
    FrameEncoder left, right;
  };

  SizedEncoders& encodersFor(int width, int height);
  std::span<const std::uint8_t> pack(FrameEncoder& encoder, const cv::Mat& image);
  void put(std::string_view key, std::string_view value);
  void putRows();
  void makeRoom();

  Database database_;
  std::unique_ptr<Statement> page_count_;  ///< present with a write-ahead log only
  std::array<std::unique_ptr<Statement>, 6> insert_;
  std::vector<SizedEncoders> encoders_;
  std::uint64_t row_bytes_ = 0, file_bytes_ = 0;
  double encode_seconds_ = 0.0;
  std::int64_t images_ = 0;
};

/// Binds a row of table `codec` to its INSERT statement.
void bindCodec(Statement& insert, std::int64_t id, const CodecParameters& parameters);
/// Removes the log files of a former recording beside `session`, because SQLite would apply them to the file
/// that replaces it. Their content is moved into the former recording first.
void foldLog(const std::filesystem::path& session);

/// Converts base_from_camera to header text (the 16 numbers of the matrix, row by row) and back (nothing if
/// malformed).
std::string formatPose(const Eigen::Isometry3d& pose);
std::optional<Eigen::Isometry3d> parsePose(std::string_view text);

}  // namespace capstan::recording
