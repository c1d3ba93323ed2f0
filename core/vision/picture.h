#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>

namespace capstan::vision {

/// Reads an image file of any kind that OpenCV knows as 8-bit BGR. Throws base::InputError for a file that
/// does not exist or is no image.
cv::Mat readPicture(const std::filesystem::path& path);

}  // namespace capstan::vision
