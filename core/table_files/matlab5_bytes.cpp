#include "core/table_files/matlab5_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/error.h"

namespace capstan::table_files {
namespace {

constexpr std::size_t kPieceBytes = 1U << 16;

}  // namespace

void refuseDamagedMatlab(const std::string& file) {
  throw base::InputError(
      {file, 0, {}, {}, "is a damaged or incomplete MATLAB file", "Save it again from the variables"});
}

void MatlabBytes::skip(std::uint64_t count) {
  std::array<char, 4096> sink;
  while (count > 0) {
    const std::size_t piece = static_cast<std::size_t>(std::min<std::uint64_t>(count, sink.size()));
    read(sink.data(), piece);
    count -= piece;
  }
}

FileBytes::FileBytes(const std::string& file, std::uint64_t begin, std::uint64_t size)
    : file_(file), in_(file, std::ios::binary), size_(size) {
  in_.seekg(static_cast<std::streamoff>(begin));
  if (!in_) refuseDamagedMatlab(file_);
}

void FileBytes::read(void* to, std::size_t count) {
  if (count > left() || !in_.read(static_cast<char*>(to), static_cast<std::streamsize>(count)))
    refuseDamagedMatlab(file_);
  position_ += count;
}

struct InflatedBytes::State {
  FileBytes from;
  std::array<unsigned char, kPieceBytes> in{};
  z_stream zlib{};
};

InflatedBytes::InflatedBytes(FileBytes compressed) : state_(new State{std::move(compressed), {}, {}}) {
  if (inflateInit(&state_->zlib) != Z_OK) refuseDamagedMatlab(state_->from.file());
}

InflatedBytes::~InflatedBytes() { inflateEnd(&state_->zlib); }

void InflatedBytes::read(void* to, std::size_t count) {
  z_stream& zlib = state_->zlib;
  const std::string& file = state_->from.file();
  if (count > std::numeric_limits<uInt>::max()) refuseDamagedMatlab(file);
  zlib.next_out = static_cast<Bytef*>(to);
  zlib.avail_out = static_cast<uInt>(count);
  while (zlib.avail_out > 0) {
    if (zlib.avail_in == 0) {
      const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(kPieceBytes, state_->from.left()));
      if (piece == 0) refuseDamagedMatlab(file);
      state_->from.read(state_->in.data(), piece);
      zlib.next_in = state_->in.data();
      zlib.avail_in = static_cast<uInt>(piece);
    }
    const int code = inflate(&zlib, Z_NO_FLUSH);
    if (code != Z_OK && !(code == Z_STREAM_END && zlib.avail_out == 0)) refuseDamagedMatlab(file);
  }
  position_ += count;
}

}  // namespace capstan::table_files
