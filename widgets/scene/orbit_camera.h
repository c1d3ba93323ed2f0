#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QSize>
#include <optional>

namespace capstan::widgets {

/// Camera that orbits a point on a turntable: azimuth about `up`, elevation above the horizon. Metres, frame
/// 0.
class OrbitCamera {
 public:
  /// Sets the axes. `up`: unit vector; azimuth is measured from the direction `ahead` (made orthogonal to
  /// up).
  void setAxes(const Eigen::Vector3d& up, const Eigen::Vector3d& ahead);
  void look(const Eigen::Vector3d& focus, double distance, double azimuth, double elevation);

  /// Rotates the camera by the given angles [rad]; the elevation stays short of the poles.
  void orbit(double azimuth, double elevation);
  /// Moves the focus by shares of the view's height, along the image's right and up directions.
  void pan(double right, double up);
  /// Multiplies the distance by `factor`, within 5 cm to 10 m.
  void zoom(double factor);
  void setFocus(const Eigen::Vector3d& focus) { focus_ = focus; }

  Eigen::Vector3d position() const;
  const Eigen::Vector3d& focus() const { return focus_; }
  Eigen::Vector3d viewUp() const;
  double distance() const { return distance_; }
  double azimuth() const { return azimuth_; }
  double elevation() const { return elevation_; }
  double viewAngle() const { return view_angle_; }  ///< vertical field of view [rad]
  const Eigen::Vector3d& up() const { return up_; }

  /// Position of a point [m, frame 0] in an image of `size`; none if it is behind the camera.
  std::optional<QPointF> project(const Eigen::Vector3d& point, const QSize& size) const;

 private:
  Eigen::Matrix3d axes() const;  ///< columns: right, up, back

  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d ahead_ = Eigen::Vector3d::UnitX();
  Eigen::Vector3d focus_ = Eigen::Vector3d::Zero();
  double distance_ = 1.0, azimuth_ = 0.0, elevation_ = 0.3;
  double view_angle_ = 0.5236;  // 30 deg
};

}  // namespace capstan::widgets
