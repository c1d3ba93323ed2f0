#include "app/python/native/arrays.h"
#include "app/python/native/module.h"
#include "core/base/error.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// Tip of each row of joints of the robot of a file; empty: the default robot.
Doubles tips(const Doubles& joints, const std::string& robot) {
  if (joints.ndim() != 2 || joints.shape(1) != 3)
    throw base::InputError({{}, 0, "joints", {}, "is no array of shape (n, 3)", "Give rows of q1, q2, q3"});
  const robot::ArmKinematics arm(robot::readDescriptionOrDefault(robot));
  std::vector<double> positions;
  positions.reserve(static_cast<std::size_t>(joints.size()));
  for (py::ssize_t row = 0; row < joints.shape(0); ++row)
    append(positions, arm.tip({joints.at(row, 0), joints.at(row, 1), joints.at(row, 2)}));
  return rowsOf(std::move(positions), 3);
}

}  // namespace

void addKinematics(py::module_& module) { module.def("tips", &tips); }

}  // namespace capstan::python
