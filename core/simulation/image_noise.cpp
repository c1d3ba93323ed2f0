#include "core/simulation/image_noise.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace capstan::simulation {

ImageNoise::ImageNoise(int width, int height, double sigma, double exposure, std::uint64_t seed)
    : sigma_(sigma), exposure_(exposure), random_(seed, "image noise") {
  if (sigma_ <= 0.0) return;
  cv::RNG rng(random_.bits());
  cv::Mat drawn(height + kMargin, width + kMargin, CV_32FC3);
  rng.fill(drawn, cv::RNG::NORMAL, 0.0, sigma_);
  drawn.convertTo(above_, CV_8U);
  drawn.convertTo(below_, CV_8U, -1.0);
}

void ImageNoise::apply(cv::Mat& image) {
  if (exposure_ > 0.0) {
    const double gain = 1.0 + exposure_ * std::clamp(random_.normal(), -3.0, 3.0);
    image.convertTo(image, -1, gain);
  }
  if (sigma_ <= 0.0) return;
  const std::uint64_t bits = random_.bits();
  const cv::Rect part(static_cast<int>(bits % kMargin), static_cast<int>(bits / kMargin % kMargin),
                      image.cols, image.rows);
  cv::add(image, above_(part), image);
  cv::subtract(image, below_(part), image);
}

}  // namespace capstan::simulation
