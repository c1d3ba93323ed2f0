#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::live {

/// Image of a Motion JPEG stream.
struct JpegPart {
  std::vector<unsigned char> bytes;               ///< a JPEG file
  std::int64_t stamp = 0;                         ///< X-Timestamp, by the clock of the server [ns]; 0: none
  std::chrono::steady_clock::time_point arrival;  ///< of its last byte
};

/// Takes the images out of a body of type multipart/x-mixed-replace (RFC 2046, 5.1), as camera servers send
/// it: lines "--BOUNDARY", header lines, an empty line, a JPEG file. The boundary is that of the first such
/// line. With Content-Length the file has that many bytes, without it ends before the next boundary.
/// X-Timestamp is the time of the image since any beginning, "SECONDS.FRACTION"; one that is not is none.
class MultipartParser {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Each = std::function<void(JpegPart&&)>;

  /// Takes bytes that arrived at a time, and calls `each` for every image that they complete. Throws
  /// base::InputError without a file name for what is no such stream, and beyond the limits below.
  void add(std::string_view bytes, TimePoint arrival, const Each& each);
  bool begun() const { return begun_; }  ///< the header of an image has come
  bool ended() const { return ended_; }  ///< the last boundary, "--BOUNDARY--", has come

  static constexpr std::size_t kMostHead = 4096;       ///< header lines of an image, or what is before it [B]
  static constexpr std::size_t kMostImage = 64 << 20;  ///< [B]

 private:
  enum class State { kBoundary, kHeader, kBody };

  bool step(TimePoint arrival, const Each& each);
  bool takeLine(std::size_t most, std::string& line);
  bool readBoundary();
  bool readHeader();
  void readField(std::string_view line);
  bool readBody(TimePoint arrival, const Each& each);
  void finish(std::size_t size, TimePoint arrival, const Each& each);

  State state_ = State::kBoundary;
  std::string buffer_, boundary_;  ///< boundary_: with the hyphens before it; empty: not known yet
  std::size_t skipped_ = 0;        ///< bytes of lines that were no boundary, or of header lines
  std::size_t length_ = 0;         ///< Content-Length; 0: none
  std::size_t searched_ = 0;       ///< bytes of buffer_ in which no boundary begins
  std::size_t before_ = 0;         ///< bytes of buffer_ that came earlier than the newest ones
  TimePoint arrival_before_;       ///< of these
  std::int64_t stamp_ = 0;
  bool begun_ = false, ended_ = false;
};

/// Nanoseconds of "SECONDS.FRACTION", both decimal digits; 0 for another text and for times that no int64
/// has.
std::int64_t parseTimestamp(std::string_view text);

}  // namespace capstan::live
