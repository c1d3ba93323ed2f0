#include "core/base/checksum.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <vector>

#include "core/base/error.h"

namespace capstan::base {
namespace {

constexpr std::uint64_t kBasis = 0xcbf29ce484222325ULL;

std::uint64_t folded(std::uint64_t hash, std::string_view bytes) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

std::string checksumOf(std::string_view text) { return fmt::format("{:016x}", folded(kBasis, text)); }

std::string checksumOfFile(const std::filesystem::path& file) {
  constexpr std::size_t kPiece = 1U << 20U;
  std::ifstream in(file, std::ios::binary);
  std::vector<char> piece(kPiece);
  std::uint64_t hash = kBasis;
  while (in) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    hash = folded(hash, {piece.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (!in.eof())
    throw InputError({file.string(), 0, {}, {}, "cannot be read", "Check the path and its permissions"});
  return fmt::format("{:016x}", hash);
}

}  // namespace capstan::base
