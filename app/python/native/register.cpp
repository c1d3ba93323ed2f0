#include <optional>
#include <string>
#include <vector>

#include "app/cli/register_output.h"
#include "app/python/native/json.h"
#include "app/python/native/module.h"
#include "app/python/native/table_input.h"
#include "core/registration/pair_table.h"
#include "core/vision/registration_file.h"
#include "core/vision/rig_file.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

registration::NamedColumns namedColumns(const TableInput& table) { return {table.name(), table.columns()}; }

cli::Registered registered(const TableInput& pairs, const std::optional<TableInput>& poses,
                           const std::string& cameras, bool exchange) {
  std::optional<vision::Triangulator> triangulator;
  if (!cameras.empty()) triangulator.emplace(vision::readRig(cameras));
  const registration::NamedColumns seen = namedColumns(pairs);
  std::optional<registration::NamedColumns> robot;
  if (poses) robot = namedColumns(*poses);
  return cli::registerRows(registration::readPairTable(seen, robot ? &*robot : nullptr), triangulator,
                           exchange, pairs.name());
}

}  // namespace

void addRegister(py::module_& module) {
  module.def(
      "register",
      [](const py::object& pairs, const py::object& poses, const std::string& cameras, bool exchange) {
        const TableInput seen(pairs);
        std::optional<TableInput> robot;
        if (!poses.is_none()) robot.emplace(poses);
        std::optional<cli::Registered> found;
        {
          const py::gil_scoped_release unlocked;
          found = registered(seen, robot, cameras, exchange);
        }
        py::dict result;
        result["report"] = documentToPython(cli::documentOf(*found));
        result["base_from_camera"] = matrixArray(found->fit.base_from_camera.matrix());
        return result;
      },
      py::arg("pairs"), py::kw_only(), py::arg("poses"), py::arg("cameras"), py::arg("exchange"));
  module.def("write_registration", [](const Doubles& matrix, const std::string& path) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (Eigen::Index i = 0; i < 4; ++i)
      for (Eigen::Index j = 0; j < 4; ++j) pose.matrix()(i, j) = matrix.at(i, j);
    vision::writeRegistration(pose, path);
  });
}

}  // namespace capstan::python
