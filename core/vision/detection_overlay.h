#pragma once

#include <array>
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/vision/marker.h"

namespace capstan::vision {

/// Draws a detection for inspection: left and right picture (8-bit BGR) side by side, on each the fitted
/// circle, a cross at the centroid, and in the upper corner the marker enlarged; in the lower corner the name
/// of the side, with the reason where the marker was not found.
cv::Mat detectionOverlay(const std::array<cv::Mat, 2>& pictures,
                         const std::array<MarkerDetection, 2>& markers);

/// Writes a picture as PNG. Throws base::InputError where it cannot be written.
void writePicture(const cv::Mat& picture, const std::filesystem::path& path);

}  // namespace capstan::vision
