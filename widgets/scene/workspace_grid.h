#pragma once

#include <Eigen/Core>
#include <QString>
#include <array>
#include <utility>
#include <vector>

namespace capstan::widgets {

/// A horizontal grid below the workspace with an upright scale at one corner, aligned with the axes of frame
/// 0.
struct WorkspaceGrid {
  struct Label {
    Eigen::Vector3d at;
    QString text;
    bool name = false;  ///< true: name of an axis; false: number
  };
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> lines;
  std::vector<Label> labels;
  Eigen::Vector3d low, high;  ///< corners: low on the grid, high at the top of the upright scale [m]
};

inline constexpr double kGridCell = 0.05;  ///< distance of grid lines [m]

/// Grid around `box`. `up_axis` 0…2 and `up_sign`: axis of frame 0 against gravity. Lines are `cell` apart
/// [m], with a number at every second one.
WorkspaceGrid gridAround(const std::array<Eigen::Vector3d, 2>& box, int up_axis, double up_sign,
                         double cell = kGridCell);

/// Index and sign of the axis of frame 0 nearest to −gravity; z without gravity.
std::pair<int, double> upAxis(const Eigen::Vector3d& gravity);

}  // namespace capstan::widgets
