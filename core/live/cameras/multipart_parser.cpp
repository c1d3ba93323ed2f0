#include "core/live/cameras/multipart_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "core/base/error.h"

namespace capstan::live {
namespace {

constexpr std::string_view kBlank = " \t\r\n";
const char* const kCheck = "Check that the address is that of the camera's Motion JPEG stream";

[[noreturn]] void refusePart(std::string key, std::string value, std::string reason) {
  throw base::InputError({"", 0, std::move(key), std::move(value), std::move(reason), kCheck});
}

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

/// Number of a text of decimal digits alone; false: it is none.
template <class Number>
bool parseDigits(std::string_view text, Number& number) {
  if (text.empty() || !std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); }))
    return false;
  return std::from_chars(text.data(), text.data() + text.size(), number).ec == std::errc();
}

}  // namespace

std::int64_t parseTimestamp(std::string_view text) {
  constexpr std::size_t kDigits = 9;  // of nanoseconds
  constexpr std::int64_t kSecond = 1000000000, kMost = 9000000000;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::int64_t seconds = 0, fraction = 0;
  if (!parseDigits(text.substr(0, point), seconds) || seconds > kMost) return 0;
  if (point == text.size()) return seconds * kSecond;
  std::string digits(text.substr(point + 1));
  digits.resize(std::max(digits.size(), kDigits), '0');
  if (!std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c); })) return 0;
  parseDigits(std::string_view(digits).substr(0, kDigits), fraction);
  return seconds * kSecond + fraction;
}

void MultipartParser::add(std::string_view bytes, TimePoint arrival, const Each& each) {
  before_ = buffer_.size();
  buffer_ += bytes;
  while (!ended_ && step(arrival, each)) continue;
  arrival_before_ = arrival;
}

bool MultipartParser::step(TimePoint arrival, const Each& each) {
  switch (state_) {
    case State::kBoundary:
      return readBoundary();
    case State::kHeader:
      return readHeader();
    case State::kBody:
      return readBody(arrival, each);
  }
  return false;
}

/// Takes a line without its end out of the buffer; false: there is none yet. Lines of more than `most` bytes
/// in all are refused.
bool MultipartParser::takeLine(std::size_t most, std::string& line) {
  const std::size_t end = buffer_.find('\n');
  skipped_ += std::min(end, buffer_.size());
  if (skipped_ > most)
    refusePart("", "", fmt::format("more than {} bytes without an image or its header", most));
  if (end == std::string::npos) {
    skipped_ -= buffer_.size();
    return false;
  }
  line = trim(std::string_view(buffer_).substr(0, end));
  buffer_.erase(0, end + 1);
  before_ -= std::min(before_, end + 1);
  return true;
}

/// Before the first boundary any line with two hyphens is one; later a wrong Content-Length leaves a part of
/// an image, in which only the known boundary is one.
bool MultipartParser::readBoundary() {
  std::string line;
  if (!takeLine(begun_ ? kMostImage : kMostHead, line)) return false;
  if (begun_ && line == boundary_ + "--") {
    ended_ = true;
  } else if (begun_ ? line == boundary_ : line.size() > 2 && line.starts_with("--")) {
    boundary_ = line;
    state_ = State::kHeader;
    skipped_ = length_ = 0;
    stamp_ = 0;
  }
  return true;
}

bool MultipartParser::readHeader() {
  std::string line;
  if (!takeLine(kMostHead, line)) return false;
  if (!line.empty()) {
    readField(line);
    return true;
  }
  begun_ = true;
  state_ = State::kBody;
  searched_ = 0;
  return true;
}

void MultipartParser::readField(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return;
  const std::string name = lowerCase(trim(line.substr(0, colon)));
  const std::string_view value = trim(line.substr(colon + 1));
  if (name == "x-timestamp") stamp_ = parseTimestamp(value);
  if (name == "content-length" && (!parseDigits(value, length_) || length_ > kMostImage))
    refusePart("Content-Length", std::string(value),
               fmt::format("not a number of bytes of an image up to {}", kMostImage));
  if (name != "content-type") return;
  const std::string type = lowerCase(trim(value.substr(0, value.find(';'))));
  if (type != "image/jpeg" && type != "image/jpg" && type != "image/pjpeg")
    refusePart("Content-Type", std::string(value), "not the type of a JPEG image, image/jpeg");
}

bool MultipartParser::readBody(TimePoint arrival, const Each& each) {
  if (length_ > 0) {
    if (buffer_.size() < length_) return false;
    finish(length_, arrival, each);
    return true;
  }
  std::size_t end = 0;  // without Content-Length: of the image and the end of its last line
  if (!buffer_.starts_with(boundary_)) {
    end = buffer_.find("\n" + boundary_, searched_);
    if (end == std::string::npos) {
      if (buffer_.size() > kMostImage)
        refusePart("", "", fmt::format("an image without Content-Length of more than {} bytes", kMostImage));
      searched_ = buffer_.size() - std::min(buffer_.size(), boundary_.size());
      return false;
    }
    if (end > 0 && buffer_[end - 1] == '\r') --end;
  }
  finish(end, end <= before_ ? arrival_before_ : arrival, each);
  return true;
}

void MultipartParser::finish(std::size_t size, TimePoint arrival, const Each& each) {
  JpegPart part{{buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(size)}, stamp_, arrival};
  buffer_.erase(0, size);
  before_ -= std::min(before_, size);
  state_ = State::kBoundary;
  skipped_ = 0;
  if (!part.bytes.empty()) each(std::move(part));
}

}  // namespace capstan::live
