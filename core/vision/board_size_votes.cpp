#include "core/vision/board_size_votes.h"

#include <algorithm>

#include "core/vision/board_finder.h"

namespace capstan::vision {

void BoardSizeVotes::observe(const cv::Mat& grey) {
  if (grey.empty()) return;
  ++images_seen_;
  if (const auto size = chessboardSize(grey)) ++votes_[{size->width, size->height}];
}

cv::Size BoardSizeVotes::expected() const {
  return {std::max(options_.board_columns, options_.board_rows),
          std::min(options_.board_columns, options_.board_rows)};
}

std::optional<cv::Size> BoardSizeVotes::other() const {
  const auto best = std::max_element(votes_.begin(), votes_.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (best == votes_.end() || best->second < 2 || 2 * best->second <= images_seen_) return std::nullopt;
  const cv::Size size(best->first.first, best->first.second);
  return size == expected() ? std::nullopt : std::optional(size);
}

bool BoardSizeVotes::canHold() const {
  const std::optional<cv::Size> size = other();
  return !size || (size->width >= expected().width && size->height >= expected().height);
}

}  // namespace capstan::vision
