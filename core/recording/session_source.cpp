#include "core/recording/session_source.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <future>
#include <limits>
#include <optional>
#include <span>

#include "core/base/yaml.h"
#include "core/recording/occlusion_events.h"
#include "core/recording/schema.h"
#include "core/recording/session_file.h"
#include "core/recording/session_reader.h"
#include "core/tracking/cover_frame.h"

namespace capstan::recording {
namespace {

constexpr int kReplayed = kFrameTable + 1;  // motor, joint, tip, frame
constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

}  // namespace

class SessionSource::Impl {
 public:
  explicit Impl(const std::filesystem::path& path) : path_(path), database_(openSession(path)) {
    try {
      readInfo();
      for (auto& codecs : codecs_) codecs = readCodecs(database_, path.string());
      recorded_ = RecordedOcclusion(database_, !info_.truth.empty());
      for (int which = 0; which < kReplayed; ++which) {
        rows_[static_cast<std::size_t>(which)] =
            std::make_unique<Statement>(rowsOf(database_, table(static_cast<SampleTable>(which))));
        advance(which);
      }
    } catch (const SqliteError& error) {
      throw damagedSession(path, error);
    }
  }

  const tracking::SourceInfo& info() const { return info_; }

  bool next(tracking::Sample& out) {
    int which = 0;
    for (int other = 1; other < kReplayed; ++other)
      if (next_[static_cast<std::size_t>(other)] < next_[static_cast<std::size_t>(which)]) which = other;
    if (next_[static_cast<std::size_t>(which)] == kEnd) return false;
    try {
      const Statement& row = *rows_[static_cast<std::size_t>(which)];
      if (!std::isfinite(row.real(1))) throw SqliteError(SQLITE_CORRUPT, "a sample has no time");
      read(static_cast<SampleTable>(which), row, out);
      advance(which);
    } catch (const SqliteError& error) {
      throw damagedSession(path_, error);
    }
    return true;
  }

  void block(bool left, bool right) { blocked_ = {left, right}; }

 private:
  void readInfo() {
    const SessionSummary summary = readSessionSummary(path_);
    const SessionHeader& header = summary.header;
    const std::string name = path_.string();
    info_.title = header.title.empty() ? path_.stem().string() : header.title;
    info_.robot = robot::parseDescription(header.robot, name + " (header robot)");
    if (!header.camera_left.empty())
      info_.rig = vision::parseStereoRig(header.camera_left, header.camera_right);
    info_.base_from_camera = header.base_from_camera;
    info_.truth = header.truth;
    info_.marker = header.marker;
    info_.tracking = header.tracking;
    info_.begin = summary.first_t;
    info_.duration = summary.last_t - summary.first_t;
    info_.reference = summary.joint > 0;
    info_.own_kinematics = header.own_kinematics;
  }

  void advance(int which) {
    const auto index = static_cast<std::size_t>(which);
    const std::int64_t before = next_[index];
    next_[index] = rows_[index]->step() ? rows_[index]->integer(0) : kEnd;
    if (next_[index] <= before) throw SqliteError(SQLITE_CORRUPT, "the rows of a table are not in order");
  }

  void read(SampleTable which, const Statement& row, tracking::Sample& out) {
    switch (which) {
      case kMotorTable:
        out = tracking::MotorSample{row.real(1), vectorAt(row, 2), vectorAt(row, 5), vectorAt(row, 8)};
        break;
      case kJointTable:
        out = tracking::JointSample{row.real(1), vectorAt(row, 2)};
        break;
      case kTipTable: {
        tracking::TipSample tip{row.real(1), row.real(2), vectorAt(row, 3)};
        if (blocked_[0] || blocked_[1]) tip.position.setConstant(std::numeric_limits<double>::quiet_NaN());
        out = tip;
        break;
      }
      default:
        readFrame(row, out);
    }
  }

  /// Returns images in memory of this source, so that samples of other kinds in between do not release it.
  /// Decoding takes more than half of the time of tracking a recording: the right image has its own thread.
  void readFrame(const Statement& row, tracking::Sample& out) {
    out = tracking::StereoFrame{row.real(1), row.real(2), {}, {}};
    auto& frame = std::get<tracking::StereoFrame>(out);
    const std::int64_t codec = row.integer(3);
    const Packet left = packetOf(row, 6), right = packetOf(row, 7);
    std::future<cv::Mat> other;
    if (left && right)
      other = std::async(std::launch::async, [&] { return unpack(right, codec, 1, frame.t); });
    frame.left = unpack(left, codec, 0, frame.t);
    frame.right = other.valid() ? other.get() : unpack(right, codec, 1, frame.t);
    frame.blocked = recorded_.at(row.integer(0), frame.t);
    tracking::coverFrame(frame, blocked_);
  }

  using Packet = std::optional<std::span<const std::uint8_t>>;  ///< nothing: there is no image
  static Packet packetOf(const Statement& row, int column) {
    return row.isNull(column) ? Packet() : Packet(row.blob(column));
  }

  cv::Mat unpack(const Packet& packet, std::int64_t codec, int side, double t) {
    if (!packet) return {};
    auto& codecs = codecs_[static_cast<std::size_t>(side)];
    cv::Mat& image = images_[static_cast<std::size_t>(side)];
    if (image.u && image.u->refcount > 1) image = cv::Mat();  // the last image is still in use elsewhere
    const auto decoder = codecs.find(codec);
    if (decoder == codecs.end() || !decoder->second.decode(*packet, image))
      throw base::InputError({path_.string(), 0, side == 0 ? "frame.left" : "frame.right",
                              fmt::format("t = {} s", t), "is a damaged image",
                              "Restore the file from a copy"});
    return image;
  }

  const std::filesystem::path path_;
  Database database_;
  tracking::SourceInfo info_;
  std::array<std::map<std::int64_t, FrameDecoder>, 2> codecs_;  ///< of each camera
  std::array<std::unique_ptr<Statement>, kReplayed> rows_;
  std::array<std::int64_t, kReplayed> next_ = {-1, -1, -1, -1};
  RecordedOcclusion recorded_;
  std::array<bool, 2> blocked_{};
  std::array<cv::Mat, 2> images_;
};

SessionSource::SessionSource(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
SessionSource::~SessionSource() = default;
const tracking::SourceInfo& SessionSource::info() const { return impl_->info(); }
bool SessionSource::next(tracking::Sample& out) { return impl_->next(out); }
void SessionSource::block(bool left, bool right) { impl_->block(left, right); }

}  // namespace capstan::recording
