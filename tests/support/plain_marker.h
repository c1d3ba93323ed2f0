#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/vision/marker.h"

namespace capstan::testing {

/// Marker detection of the UKF paper with OpenCV's own functions: reference for results and speed.
struct PlainMarker {
  cv::Mat hsv, thresholded, second, smoothed, eroded, mask;
  std::vector<std::vector<cv::Point>> contours;

  const cv::Mat& clean(const cv::Mat& bgr, const vision::MarkerOptions& options) {
    cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
    const auto range = [&](int from, int to, cv::Mat& out) {
      cv::inRange(hsv, cv::Scalar(from, options.saturation_low, options.value_low), cv::Scalar(to, 255, 255),
                  out);
    };
    if (options.hue_low <= options.hue_high) {
      range(options.hue_low, options.hue_high, thresholded);
    } else {
      range(options.hue_low, 179, thresholded);
      range(0, options.hue_high, second);
      cv::bitwise_or(thresholded, second, thresholded);
    }
    cv::medianBlur(thresholded, smoothed, 5);
    cv::erode(smoothed, eroded, cv::Mat());
    cv::dilate(eroded, mask, cv::Mat());
    return mask;
  }

  /// Centroid of the largest contour, in pixels of `bgr`.
  std::optional<Eigen::Vector2d> detect(const cv::Mat& bgr, const vision::MarkerOptions& options,
                                        double* radius = nullptr) {
    clean(bgr, options);
    cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    const std::vector<cv::Point>* largest = nullptr;
    double largest_area = 0.0;
    for (const auto& contour : contours)
      if (const double area = cv::contourArea(contour); area > largest_area) {
        largest_area = area;
        largest = &contour;
      }
    if (largest == nullptr) return std::nullopt;
    const cv::Moments moments = cv::moments(*largest);
    cv::Point2f centre;
    float enclosing = 0.0F;
    cv::minEnclosingCircle(*largest, centre, enclosing);
    if (radius != nullptr) *radius = enclosing;
    return Eigen::Vector2d(moments.m10 / moments.m00, moments.m01 / moments.m00);
  }
};

}  // namespace capstan::testing
