#include <algorithm>
#include <vector>

#include "core/base/error.h"
#include "core/live/cameras/multipart_parser.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace capstan;

struct Taken {
  std::vector<std::vector<unsigned char>> images;
  std::vector<std::int64_t> stamps;
  bool refused = false;

  bool operator==(const Taken&) const = default;
};

Taken takenFrom(std::string_view bytes, std::size_t piece) {
  live::MultipartParser parser;
  Taken taken;
  const auto keep = [&](live::JpegPart&& part) {
    fuzz::require(!part.bytes.empty(), "an image has bytes");
    fuzz::require(part.bytes.size() <= live::MultipartParser::kMostImage, "an image has at most kMostImage");
    taken.images.push_back(std::move(part.bytes));
    taken.stamps.push_back(part.stamp);
  };
  try {
    for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size())))
      parser.add(bytes.substr(0, piece), {}, keep);
  } catch (const base::InputError& error) {  // who knows the address adds it
    fuzz::require(!error.fault().reason.empty() && !error.fault().remedy.empty(), "reason and remedy");
    taken.refused = true;
  }
  fuzz::require(parser.begun() || taken.images.empty(), "an image has a header");
  return taken;
}

}  // namespace

/// Body of a Motion JPEG stream, in pieces as they may come: its images do not depend on these. The first
/// byte is the size of the pieces.
CAPSTAN_FUZZ_TARGET(multipart) {
  if (bytes.empty()) return;
  const std::size_t piece = 1 + static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  fuzz::require(takenFrom(bytes, piece) == takenFrom(bytes, bytes.size() + 1),
                "the same images for any pieces");
}
