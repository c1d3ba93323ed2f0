#include "widgets/scene/workspace_grid.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "widgets/figures/number_text.h"

namespace capstan::widgets {

namespace {

using Eigen::Vector3d;

QString millimetres(double metres) {
  return withMinus(QString::number(std::lround(base::toMillimetres(metres))));
}

bool numbered(double metres, double cell) { return std::abs(std::remainder(metres, 2.0 * cell)) < 1e-6; }

/// Adds lines across axis `a` at each cell of axis `b`, in the plane of `grid.low`, and their numbers.
void ruleAlong(WorkspaceGrid& grid, int a, int b, double cell) {
  const double beyond = 0.36 * cell;
  for (int i = 0; grid.low(b) + i * cell <= grid.high(b) + 1e-9; ++i) {
    Vector3d from = grid.low, to = grid.low;
    from(b) = to(b) = grid.low(b) + i * cell;
    to(a) = grid.high(a);
    grid.lines.emplace_back(from, to);
    Vector3d at = to;
    at(a) += beyond;
    if (numbered(from(b), cell)) grid.labels.push_back({at, millimetres(from(b))});
  }
  Vector3d at = grid.low;
  at(a) = grid.high(a) + 3.2 * beyond;
  at(b) = 0.5 * (grid.low(b) + grid.high(b));
  grid.labels.push_back({at, QString("%1 [mm]").arg("xyz"[b]), true});
}

}  // namespace

std::pair<int, double> upAxis(const Vector3d& gravity) {
  int axis = 2;
  if (gravity.norm() < 1e-9) return {axis, 1.0};
  gravity.cwiseAbs().maxCoeff(&axis);
  return {axis, gravity(axis) > 0.0 ? -1.0 : 1.0};
}

WorkspaceGrid gridAround(const std::array<Vector3d, 2>& box, int up_axis, double up_sign, double cell) {
  WorkspaceGrid grid;
  for (int i = 0; i < 3; ++i) {
    grid.low(i) = std::floor((box[0](i) - 0.2 * cell) / cell) * cell;
    grid.high(i) = std::ceil((box[1](i) + 0.2 * cell) / cell) * cell;
  }
  if (up_sign < 0.0) std::swap(grid.low(up_axis), grid.high(up_axis));
  const int a = (up_axis + 1) % 3, b = (up_axis + 2) % 3;
  ruleAlong(grid, a, b, cell);
  ruleAlong(grid, b, a, cell);
  Vector3d top = grid.low;
  top(up_axis) = grid.high(up_axis);
  grid.lines.emplace_back(grid.low, top);
  const int cells = static_cast<int>(std::lround(std::abs(grid.high(up_axis) - grid.low(up_axis)) / cell));
  for (int i = 0; i <= cells; ++i) {
    Vector3d at = grid.low;
    at(up_axis) += up_sign * i * cell;
    Vector3d tick = at;
    tick(a) += 0.2 * cell;
    grid.lines.emplace_back(at, tick);
    tick(a) = at(a) - 0.36 * cell;
    if (numbered(at(up_axis), cell)) grid.labels.push_back({tick, millimetres(at(up_axis))});
  }
  top(up_axis) += up_sign * 0.5 * cell;
  grid.labels.push_back({top, QString("%1 [mm]").arg("xyz"[up_axis]), true});
  return grid;
}

}  // namespace capstan::widgets
