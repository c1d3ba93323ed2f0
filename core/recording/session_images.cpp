#include "core/recording/session_images.h"

#include <fmt/format.h>

#include <cmath>

#include "core/recording/session_reader.h"

namespace capstan::recording {

class SessionImages::Impl {
 public:
  explicit Impl(const std::filesystem::path& path) : path_(path), database_(openSession(path)) {
    try {
      codecs_ = readCodecs(database_, path.string());
      // Times rise with the key, so that the key's index finds a time by bisection.
      ends_ = std::make_unique<Statement>(database_, "SELECT min(seq), max(seq) FROM frame");
      up_to_ = std::make_unique<Statement>(
          database_, "SELECT seq, t FROM frame WHERE seq <= ? ORDER BY seq DESC LIMIT 1");
      from_ = std::make_unique<Statement>(database_,
                                          "SELECT seq, t FROM frame WHERE seq > ? ORDER BY seq LIMIT 1");
      pair_ = std::make_unique<Statement>(rowsOf(database_, table(kFrameTable), "WHERE seq = ?"));
    } catch (const SqliteError& error) {
      throw damagedSession(path, error);
    }
  }

  bool at(double t, double reach, tracking::StereoFrame& out) {
    try {
      const std::int64_t seq = nearest(t);
      if (seq < 0) return false;
      pair_->reset();
      pair_->bind(1, seq);
      if (!pair_->step() || std::abs(pair_->real(1) - t) > reach) return false;
      out.t = pair_->real(1);
      out.t_arrival = pair_->real(2);
      unpack(6, out.t, out.left);
      unpack(7, out.t, out.right);
    } catch (const SqliteError& error) {
      throw damagedSession(path_, error);
    }
    return true;
  }

 private:
  struct Place {
    std::int64_t seq = -1;
    double t = 0.0;
  };
  static Place find(Statement& statement, std::int64_t seq) {
    statement.reset();
    statement.bind(1, seq);
    return statement.step() ? Place{statement.integer(0), statement.real(1)} : Place{};
  }

  // Key of the pair nearest to t; −1: there is none.
  std::int64_t nearest(double t) {
    ends_->reset();
    if (!ends_->step() || ends_->isNull(0)) return -1;
    std::int64_t low = ends_->integer(0), high = ends_->integer(1);
    if (low < 0) throw SqliteError(SQLITE_CORRUPT, "a row of table frame has a negative seq");
    while (low < high) {  // the first pair at or after t
      const std::int64_t middle = low + (high - low) / 2;
      const Place place = find(*up_to_, middle);
      if (place.t < t)
        low = middle + 1;
      else
        high = place.seq;
    }
    const Place before = find(*up_to_, low - 1), after = find(*from_, low - 1);
    if (before.seq < 0) return after.seq;
    if (after.seq < 0) return before.seq;
    return t - before.t <= after.t - t ? before.seq : after.seq;
  }

  void unpack(int column, double t, cv::Mat& image) {
    image = cv::Mat();
    if (pair_->isNull(column)) return;
    const auto decoder = codecs_.find(pair_->integer(3));
    if (decoder == codecs_.end() || !decoder->second.decode(pair_->blob(column), image))
      throw base::InputError({path_.string(), 0, column == 6 ? "frame.left" : "frame.right",
                              fmt::format("t = {} s", t), "is a damaged image",
                              "Restore the file from a copy"});
  }

  const std::filesystem::path path_;
  Database database_;
  std::map<std::int64_t, FrameDecoder> codecs_;
  std::unique_ptr<Statement> ends_, up_to_, from_, pair_;
};

SessionImages::SessionImages(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
SessionImages::~SessionImages() = default;
bool SessionImages::at(double t, double reach, tracking::StereoFrame& out) {
  return impl_->at(t, reach, out);
}

}  // namespace capstan::recording
