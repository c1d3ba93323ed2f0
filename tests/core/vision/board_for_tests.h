#pragma once

#include <numbers>
#include <opencv2/aruco.hpp>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/vision/calibration.h"
#include "core/vision/camera.h"

/// Pictures of calibration boards, for tests: a picture of the board is cast along each pixel's rays through
/// Camera::normalise, then blurred slightly, with noise.
namespace capstan::test {

/// A board as a picture; the board's origin is at `origin`, its x axis along columns.
struct BoardPicture {
  cv::Mat texture;
  double scale = 0.0;  ///< [px/m]
  Eigen::Vector2d origin;
};

inline BoardPicture pictureOf(const vision::CalibrationOptions& options) {
  constexpr double kPerSquare = 60.0;
  const double scale = kPerSquare / options.square_size;
  const double margin = 0.5 * options.square_size;
  const auto pixels = [&](double metres) { return static_cast<int>(std::lround(scale * metres)); };
  const auto marker = static_cast<float>(options.marker_size),
             square = static_cast<float>(options.square_size);
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_250);
  BoardPicture picture{{}, scale, {margin, margin}};
  if (options.board == vision::BoardKind::kChessboard) {
    const int columns = options.board_columns + 1, rows = options.board_rows + 1;
    picture.texture = cv::Mat(pixels(rows * options.square_size + 2.0 * margin),
                              pixels(columns * options.square_size + 2.0 * margin), CV_8U, cv::Scalar(210));
    for (int row = 0; row < rows; ++row)
      for (int column = row % 2; column < columns; column += 2)
        cv::rectangle(picture.texture,
                      cv::Rect(pixels(column * options.square_size + margin),
                               pixels(row * options.square_size + margin), pixels(square), pixels(square)),
                      cv::Scalar(30), cv::FILLED);
    picture.origin.array() += options.square_size;  // the first inner corner
  } else if (options.board == vision::BoardKind::kCharuco) {
    const int columns = options.board_columns + 1, rows = options.board_rows + 1;
    cv::Mat drawn;
    cv::aruco::CharucoBoard::create(columns, rows, square, marker, dictionary)
        ->draw({pixels(columns * options.square_size), pixels(rows * options.square_size)}, drawn);
    cv::copyMakeBorder(drawn, picture.texture, pixels(margin), pixels(margin), pixels(margin), pixels(margin),
                       cv::BORDER_CONSTANT, 255);
  } else {
    const double width = (options.board_columns - 1) * options.square_size + options.marker_size;
    const double height = (options.board_rows - 1) * options.square_size + options.marker_size;
    cv::Mat drawn;
    cv::aruco::GridBoard::create(options.board_columns, options.board_rows, marker, square - marker,
                                 dictionary)
        ->draw({pixels(width), pixels(height)}, drawn);
    cv::copyMakeBorder(drawn, picture.texture, pixels(margin), pixels(margin), pixels(margin), pixels(margin),
                       cv::BORDER_CONSTANT, 255);
  }
  return picture;
}

/// Renders images of boards as a camera gives them.
class BoardCamera {
 public:
  explicit BoardCamera(const vision::Camera& camera) : size_(camera.width, camera.height) {
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x)
        rays_.push_back(camera.normalise({static_cast<double>(x), static_cast<double>(y)}).homogeneous());
  }

  cv::Mat image(const BoardPicture& board, const Eigen::Isometry3d& camera_from_board,
                base::Random& random) const {
    const Eigen::Isometry3d board_from_camera = camera_from_board.inverse();
    const Eigen::Vector3d eye = board_from_camera.translation();
    cv::Mat at_x(size_, CV_32F), at_y(size_, CV_32F), soft, image;
    for (int i = 0; i < size_.area(); ++i) {
      const Eigen::Vector3d ray = board_from_camera.linear() * rays_[static_cast<std::size_t>(i)];
      const Eigen::Vector3d hit = eye - eye.z() / ray.z() * ray;
      at_x.at<float>(i) = static_cast<float>(board.scale * (hit.x() + board.origin.x()) - 0.5);
      at_y.at<float>(i) = static_cast<float>(board.scale * (hit.y() + board.origin.y()) - 0.5);
    }
    cv::GaussianBlur(board.texture, soft, cv::Size(), 1.0);  // a pixel covers two of the texture
    cv::remap(soft, image, at_x, at_y, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 120);
    cv::GaussianBlur(image, image, cv::Size(), 0.7);
    for (int i = 0; i < size_.area(); ++i)
      image.at<std::uint8_t>(i) =
          cv::saturate_cast<std::uint8_t>(image.at<std::uint8_t>(i) + random.normal(0.0, 1.5));
    return image;
  }

 private:
  cv::Size size_;
  std::vector<Eigen::Vector3d> rays_;
};

/// Pose of the board in the left camera for view `i` of `views`: turned about another axis each, its middle
/// round the image, nearer and farther.
inline Eigen::Isometry3d boardPose(const vision::CalibrationOptions& options, int i, int views,
                                   double reach = 0.06) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double angle = 2.0 * std::numbers::pi * i / views;
  pose.linear() = (Eigen::AngleAxisd(0.55, Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)) *
                   Eigen::AngleAxisd(0.1 * (i % 3 - 1), Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  const Eigen::Vector3d middle(0.5 * options.board_columns * options.square_size,
                               0.5 * options.board_rows * options.square_size, 0.0);
  pose.translation() = Eigen::Vector3d(0.02 + reach * std::cos(2.0 * angle),
                                       0.7 * reach * std::sin(3.0 * angle), 0.42 + 0.05 * (i % 2)) -
                       pose.linear() * middle;
  return pose;
}

}  // namespace capstan::test
