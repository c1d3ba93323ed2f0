// Decoding checks every length against the bytes: messages come from files and programs of others.
#include <cstring>
#include <span>
#include <stdexcept>

#include "core/ros1/message_codec.h"
#include "core/ros1/stamp.h"

namespace capstan::ros1 {
namespace {

/// Reads the serialised form of a message (wiki.ros.org/ROS/Technical Overview): little-endian numbers, texts
/// and lists after their lengths.
class WireReader {
 public:
  explicit WireReader(const Bytes& bytes) : left_(bytes) {}

  template <class Number>
  Number number() {
    Number value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() {
    const auto part = take(number<std::uint32_t>());
    return {part.begin(), part.end()};
  }
  Bytes bytes() {
    const auto part = take(number<std::uint32_t>());
    return {part.begin(), part.end()};
  }
  std::vector<double> numbers() {
    const std::uint32_t count = number<std::uint32_t>();
    const auto part = take(sizeof(double) * static_cast<std::size_t>(count));
    std::vector<double> values(count);
    if (count > 0) std::memcpy(values.data(), part.data(), part.size());
    return values;
  }
  std::vector<std::string> texts() {
    constexpr std::size_t kShortest = 4;  // bytes of an empty text
    const std::uint32_t count = number<std::uint32_t>();
    if (count > left_.size() / kShortest) throw std::runtime_error("a list exceeds the message");
    std::vector<std::string> texts;
    for (std::uint32_t k = 0; k < count; ++k) texts.push_back(text());
    return texts;
  }
  template <std::size_t n>
  std::array<double, n> array() {
    std::array<double, n> values;
    std::memcpy(values.data(), take(sizeof values).data(), sizeof values);
    return values;
  }
  MessageHeader header() {
    number<std::uint32_t>();  // counter
    const auto seconds = number<std::uint32_t>(), nanoseconds = number<std::uint32_t>();
    return {seconds * kSecond + nanoseconds, text()};
  }

 private:
  std::span<const std::uint8_t> take(std::size_t size) {
    if (size > left_.size()) throw std::runtime_error("it ends too early");
    const auto part = left_.first(size);
    left_ = left_.subspan(size);
    return part;
  }
  std::span<const std::uint8_t> left_;
};

}  // namespace

// The order of the fields is that of the definitions; braces evaluate in order.
template <>
JointState decode<JointState>(const Bytes& bytes) {
  WireReader wire(bytes);
  return JointState{wire.header(), wire.texts(), wire.numbers(), wire.numbers(), wire.numbers()};
}

template <>
Image decode<Image>(const Bytes& bytes) {
  WireReader wire(bytes);
  Image m;
  m.header = wire.header();
  m.height = wire.number<std::uint32_t>(), m.width = wire.number<std::uint32_t>();
  m.encoding = wire.text();
  m.big_endian = wire.number<std::uint8_t>() != 0;
  m.step = wire.number<std::uint32_t>();
  m.data = wire.bytes();
  return m;
}

template <>
CompressedImage decode<CompressedImage>(const Bytes& bytes) {
  WireReader wire(bytes);
  return CompressedImage{wire.header(), wire.text(), wire.bytes()};
}

template <>
CameraInfo decode<CameraInfo>(const Bytes& bytes) {
  WireReader wire(bytes);
  CameraInfo m;
  m.header = wire.header();
  m.height = wire.number<std::uint32_t>(), m.width = wire.number<std::uint32_t>();
  m.distortion_model = wire.text();
  m.d = wire.numbers();
  m.k = wire.array<9>(), m.r = wire.array<9>(), m.p = wire.array<12>();
  return m;
}

template <>
Text decode<Text>(const Bytes& bytes) {
  return Text{WireReader(bytes).text()};
}

template <>
PointStamped decode<PointStamped>(const Bytes& bytes) {
  WireReader wire(bytes);
  return PointStamped{wire.header(), wire.array<3>()};
}

}  // namespace capstan::ros1
