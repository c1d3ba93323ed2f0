#include "core/live/streams/igtl_message.h"

#include <array>
#include <bit>
#include <cmath>

#include "core/base/check.h"

namespace capstan::live {
namespace {

constexpr std::size_t kType = 12, kDevice = 20;  // bytes of the names in the header
constexpr double kMillimetres = 1e3;             // of a metre

constexpr std::array<std::uint64_t, 256> kChecksums = [] {
  std::array<std::uint64_t, 256> table{};
  for (std::uint64_t byte = 0; byte < table.size(); ++byte) {
    std::uint64_t rest = byte << 56;
    for (int bit = 0; bit < 8; ++bit) rest = rest << 1 ^ (rest >> 63 != 0 ? 0x42F0E1EBA9EA3693ULL : 0);
    table[byte] = rest;
  }
  return table;
}();

template <class Number>
void append(std::string& to, Number number) {
  for (int shift = 8 * static_cast<int>(sizeof number) - 8; shift >= 0; shift -= 8)
    to += static_cast<char>(number >> shift & 0xFF);
}

void appendName(std::string& to, std::string_view name, std::size_t size) {
  to += name;
  to.append(size - name.size(), '\0');
}

}  // namespace

std::uint64_t igtlChecksum(std::string_view bytes) {
  std::uint64_t rest = 0;
  for (const char byte : bytes)
    rest = kChecksums[(rest >> 56) ^ static_cast<unsigned char>(byte)] ^ rest << 8;
  return rest;
}

std::string igtlTransform(std::string_view device, const Eigen::Isometry3d& pose, double time) {
  CAPSTAN_ASSERT(device.size() <= kDevice);
  std::string body;
  const auto put = [&](double x) { append(body, std::bit_cast<std::uint32_t>(static_cast<float>(x))); };
  const Eigen::Matrix3d rotation = pose.linear();
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) put(rotation(row, column));
  for (const double x : pose.translation()) put(kMillimetres * x);

  constexpr std::uint16_t kVersion = 1;
  const double whole = std::floor(time);
  std::string message;
  append(message, kVersion);
  appendName(message, "TRANSFORM", kType);
  appendName(message, device, kDevice);
  append(message, static_cast<std::uint32_t>(whole));
  append(message, static_cast<std::uint32_t>((time - whole) * 0x1p32));
  append(message, static_cast<std::uint64_t>(body.size()));
  append(message, igtlChecksum(body));
  return message + body;
}

}  // namespace capstan::live
