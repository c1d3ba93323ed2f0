#include "core/registration/pair_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/table_files/read_columns.h"

namespace capstan::registration {
namespace {

using Name = const char*;
constexpr std::array<Name, 3> kBase = {"x", "y", "z"};
constexpr std::array<Name, 3> kCamera = {"cam_x", "cam_y", "cam_z"};
constexpr std::array<Name, 4> kPixels = {"left_u", "left_v", "right_u", "right_v"};

struct Columns {
  std::string file;
  table_files::TableLines lines;
  std::map<std::string, std::vector<double>, std::less<>> values;  // of the columns that the table has

  bool haveAll(std::span<const Name> names) const {
    return std::ranges::all_of(names, [&](Name name) { return values.contains(name); });
  }
  void require(std::span<const Name> names, const std::string& remedy) const {
    for (Name name : names)
      if (!values.contains(name))
        throw base::InputError({file, lines.header(), name, {}, "the column is missing", remedy});
  }
  double at(Name name, std::size_t row) const {
    const double value = values.find(name)->second[row];
    if (!std::isfinite(value))
      throw base::InputError(
          lines.at(file, row, name, fmt::format("{}", value), "is not a finite number", "Remove the row"));
    return value;
  }
  Eigen::Vector3d point(const std::array<Name, 3>& names, std::size_t row) const {
    return {at(names[0], row), at(names[1], row), at(names[2], row)};
  }
};

bool isKnown(std::string_view name) {
  const auto has = [&](std::span<const Name> names) { return std::ranges::find(names, name) != names.end(); };
  return has(kBase) || has(kCamera) || has(kPixels);
}

Columns readColumns(const std::filesystem::path& path) {
  const auto reader = table_files::columnsIn(path);
  Columns columns{path.string(), reader.lines, {}};
  reader.read([&](std::string_view name, std::size_t) -> std::vector<double>* {
    if (!isKnown(name)) return nullptr;
    const auto [column, added] = columns.values.try_emplace(std::string(name));
    if (!added)
      throw base::InputError({columns.file,
                              columns.lines.header(),
                              std::string(name),
                              {},
                              "the column is given twice",
                              "Remove one"});
    return &column->second;
  });
  return columns;
}

Eigen::Vector3d triangulated(const Columns& columns, std::size_t row,
                             const vision::Triangulator& triangulator) {
  const auto pixel = [&](std::size_t first) {
    return Eigen::Vector2d(columns.at(kPixels[first], row), columns.at(kPixels[first + 1], row));
  };
  const auto seen = triangulator.triangulate(pixel(0), pixel(2), 1.0, 1.0);
  if (!seen.found())
    throw base::InputError(columns.lines.at(
        columns.file, row, "left_u, left_v, right_u, right_v", {},
        fmt::format("the rays do not meet in front of the cameras ({})", base::nameOf(seen.fault)),
        "Check whether the left and the right camera are exchanged, or remove the row"));
  return seen.position;
}

}  // namespace

PairTable readPairTable(const std::filesystem::path& path,
                        const std::optional<vision::Triangulator>& triangulator) {
  const Columns columns = readColumns(path);
  const bool points = columns.haveAll(kCamera);
  columns.require(kBase, "Give the tip's position in the base frame as x, y, z [m]");
  if (!points) {
    columns.require(kPixels,
                    "Give the marker as cam_x, cam_y, cam_z [m] or as left_u, left_v, right_u, "
                    "right_v [px]");
    if (!triangulator)
      throw base::InputError({columns.file,
                              columns.lines.header(),
                              kPixels[0],
                              {},
                              "pixels need the calibrated cameras",
                              "Give the folder of the cameras"});
  }
  PairTable table;
  const std::size_t rows = columns.values.find(kBase[0])->second.size();
  for (std::size_t row = 0; row < rows; ++row) {
    table.base.push_back(columns.point(kBase, row));
    table.camera.push_back(points ? columns.point(kCamera, row) : triangulated(columns, row, *triangulator));
  }
  return table;
}

}  // namespace capstan::registration
