#include "core/vision/picture.h"

#include <opencv2/imgcodecs.hpp>

#include "core/base/error.h"

namespace capstan::vision {

cv::Mat readPicture(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw base::InputError({path.string(), 0, {}, {}, "is not there", "Give the path of an image"});
  cv::Mat picture = cv::imread(path.string(), cv::IMREAD_COLOR);
  if (picture.empty())
    throw base::InputError(
        {path.string(), 0, {}, {}, "is not a readable image", "Give a PNG, JPEG, TIFF or BMP file"});
  return picture;
}

}  // namespace capstan::vision
