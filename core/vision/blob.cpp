#include "core/vision/blob.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace capstan::vision {

namespace {

/// Calls run(begin, end) for every run of set pixels of a row, left to right.
template <class Take>
void forEachRun(const BitImage& image, int y, Take&& take) {
  const std::uint64_t* row = image.row(y);
  int begin = -1;  // of the open run
  for (int word = 0; word < image.words(); ++word) {
    const int base = 64 * word;
    std::uint64_t rest = begin < 0 ? row[word] : ~row[word];  // next change
    while (rest != 0) {
      const int bit = std::countr_zero(rest);
      if (begin < 0) {
        begin = base + bit;
      } else {
        take(begin, base + bit);
        begin = -1;
      }
      const std::uint64_t ahead = ~std::uint64_t{0} << bit;
      rest = (begin < 0 ? row[word] : ~row[word]) & ahead;
    }
  }
  if (begin >= 0) take(begin, image.width());
}

}  // namespace

BlobFinder::BlobFinder(int max_width, int max_height) {
  const std::size_t most =
      (static_cast<std::size_t>(max_width) / 4 + 1) * static_cast<std::size_t>(max_height);
  runs_.reserve(most);
  parents_.reserve(most);
  blobs_.reserve(most);
  contour_.reserve(4 * static_cast<std::size_t>(max_width + max_height));
}

std::int32_t BlobFinder::root(std::int32_t label) {
  while (parents_[label] != label) label = parents_[label] = parents_[parents_[label]];
  return label;
}

void BlobFinder::join(Run& run, std::int32_t other) {
  other = root(other);
  if (run.label < 0) {
    run.label = other;
    return;
  }
  const std::int32_t mine = root(run.label);
  parents_[std::max(mine, other)] = std::min(mine, other);
  run.label = std::min(mine, other);
}

std::span<const Blob> BlobFinder::find(const BitImage& image, RowSpan rows) {
  runs_.clear();
  parents_.clear();
  blobs_.clear();
  std::size_t above = 0, above_end = 0;  // runs of the row before
  for (int y = rows.first; y <= rows.last; ++y) {
    const std::size_t first = runs_.size();
    forEachRun(image, y, [&](int begin, int end) {
      Run run{static_cast<std::int16_t>(begin), static_cast<std::int16_t>(end), -1};
      while (above < above_end && runs_[above].end < begin) ++above;
      for (std::size_t i = above; i < above_end && runs_[i].begin <= end; ++i) join(run, runs_[i].label);
      if (run.label < 0) {
        run.label = static_cast<std::int32_t>(parents_.size());
        parents_.push_back(run.label);
        blobs_.push_back({0, begin, y, begin, end - 1, y, y});
      }
      Blob& blob = blobs_[run.label];
      blob.area += end - begin;
      blob.left = std::min(blob.left, begin);
      blob.right = std::max(blob.right, end - 1);
      blob.bottom = y;
      runs_.push_back(run);
    });
    above = first;
    above_end = runs_.size();
  }
  for (std::size_t i = 0; i < blobs_.size(); ++i) {
    Blob& to = blobs_[root(static_cast<std::int32_t>(i))];
    if (&to == &blobs_[i]) continue;
    to.area += blobs_[i].area;
    to.left = std::min(to.left, blobs_[i].left);
    to.right = std::max(to.right, blobs_[i].right);
    to.bottom = std::max(to.bottom, blobs_[i].bottom);
    blobs_[i].area = 0;
  }
  std::erase_if(blobs_, [](const Blob& blob) { return blob.area == 0; });
  std::sort(blobs_.begin(), blobs_.end(), [](const Blob& a, const Blob& b) {
    return a.area != b.area ? a.area > b.area
                            : std::pair(a.first_y, a.first_x) < std::pair(b.first_y, b.first_x);
  });
  return blobs_;
}

ContourMoments BlobFinder::trace(const BitImage& image, const Blob& blob) {
  // Directions clockwise on the screen, from right: 0 = +x, 2 = +y, 4 = −x, 6 = −y.
  static constexpr std::array<int, 8> kStepX{1, 1, 0, -1, -1, -1, 0, 1};
  static constexpr std::array<int, 8> kStepY{0, 1, 1, 1, 0, -1, -1, -1};
  const auto set = [&](int x, int y) {
    return x >= blob.left && x <= blob.right && y >= blob.top && y <= blob.bottom && image.at(x, y);
  };
  contour_.clear();
  int x = blob.first_x, y = blob.first_y, from = 4;  // entered from the left: nothing is set there
  int first_step = -1;
  double twice_area = 0.0, moment_x = 0.0, moment_y = 0.0;  // about the first point
  int straight = 0, diagonal = 0;
  while (true) {
    int step = -1;
    for (int k = 1; k <= 8; ++k) {
      const int candidate = (from + k) & 7;
      if (set(x + kStepX[candidate], y + kStepY[candidate])) {
        step = candidate;
        break;
      }
    }
    if (step < 0) break;  // a single pixel
    if (x == blob.first_x && y == blob.first_y) {
      if (first_step < 0)
        first_step = step;
      else if (step == first_step)
        break;
    }
    if (contour_.size() < contour_.capacity())
      contour_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    const double ax = x - blob.first_x, ay = y - blob.first_y;
    const double bx = ax + kStepX[step], by = ay + kStepY[step];
    const double cross = ax * by - bx * ay;
    twice_area += cross;
    moment_x += cross * (ax + bx);
    moment_y += cross * (ay + by);
    ++(step & 1 ? diagonal : straight);
    x += kStepX[step];
    y += kStepY[step];
    from = (step + 4) & 7;
  }
  ContourMoments moments;
  moments.area = 0.5 * std::abs(twice_area);
  moments.perimeter = straight + std::numbers::sqrt2 * diagonal;
  moments.centroid = {blob.first_x, blob.first_y};
  if (twice_area != 0.0) moments.centroid += Eigen::Vector2d(moment_x, moment_y) / (3.0 * twice_area);
  return moments;
}

}  // namespace capstan::vision
