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

/// Writes the rows of a session file. One thread; every call may wait for the disk. Sample rows carry their
/// `seq`, each used once.
class SessionWriter {
 public:
  /// How hard commits try. kFast: a commit reaches the operating system (it survives the process, and a loss
  /// of power leaves a whole file that ends earlier, given that somebody else checkpoints); kPlain: an
  /// ordinary rollback journal, for imports, on the disk when finish() returns.
  enum class Durability { kFast, kPlain };

  /// Creates `path`. Throws base::InputError when the file exists or cannot be created.
  SessionWriter(const std::filesystem::path& path, const SessionHeader& header, Durability durability);

  // All of these throw SqliteError.
  void begin();
  /// With kFast the main file has room for every page before the log gets it, so that the log can always be
  /// moved there, on a full disk too. SQLITE_FULL: the disk had none; roll back.
  void commit();
  void rollback() noexcept;

  void write(std::int64_t seq, const tracking::MotorSample& sample);
  void write(std::int64_t seq, const tracking::JointSample& sample);
  void write(std::int64_t seq, const tracking::TipSample& sample);
  /// Encodes and writes; an empty image becomes NULL. Images of a pair have one size.
  void write(std::int64_t seq, const tracking::StereoFrame& frame);
  void write(std::int64_t seq, const EstimateRow& row);
  void write(std::int64_t seq, const SessionEvent& event);
  void setRegistration(const Eigen::Isometry3d& base_from_camera);

  /// Moves the write-ahead log into the file and takes it away: true, the session is one plain file from here
  /// on. This takes no space on the disk. False: another connection reads the session, and the log stays
  /// beside it, whole and on the disk.
  bool finish();

  Database& database() { return database_; }
  std::uint64_t rowBytes() const { return row_bytes_; }     ///< payload written so far
  std::uint64_t fileBytes() const { return file_bytes_; }   ///< pages of the file at the last commit
  double encodeSeconds() const { return encode_seconds_; }  ///< processor time of all encoding
  std::int64_t images() const { return images_; }           ///< encoded so far

 private:
  /// Encoders of one image size; one for each side, because a packet lives until the next.
  struct SizedEncoders {
    int width, height;
    std::int64_t codec;
    FrameEncoder left, right;
  };

  SizedEncoders& encodersFor(int width, int height);
  std::span<const std::uint8_t> pack(FrameEncoder& encoder, const cv::Mat& image);
  void put(std::string_view key, std::string_view value);
  void makeRoom();

  Database database_;
  std::unique_ptr<Statement> page_count_;  ///< with a write-ahead log only
  std::array<std::unique_ptr<Statement>, 6> insert_;
  std::vector<SizedEncoders> encoders_;
  std::uint64_t row_bytes_ = 0, file_bytes_ = 0;
  double encode_seconds_ = 0.0;
  std::int64_t images_ = 0;
};

/// base_from_camera as header text: the 16 numbers of the matrix, row by row; and back (nothing when
/// malformed).
std::string formatPose(const Eigen::Isometry3d& pose);
std::optional<Eigen::Isometry3d> parsePose(std::string_view text);

}  // namespace capstan::recording
