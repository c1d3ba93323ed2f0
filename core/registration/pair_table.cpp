#include "core/registration/pair_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/table_files/read_columns.h"

namespace capstan::registration {
namespace {

using Name = const char*;
constexpr std::array<Name, 3> kBase = {"x", "y", "z"};
constexpr std::array<Name, 3> kCamera = {"cam_x", "cam_y", "cam_z"};
constexpr std::array<Name, 4> kPixels = {"left_u", "left_v", "right_u", "right_v"};
constexpr std::array<Name, 2> kSigmas = {"left_sigma", "right_sigma"};

class Columns {
 public:
  explicit Columns(const NamedColumns& table) : file_(table.name), header_(table.columns.lines.header()) {
    table.columns.read([&](std::string_view name, std::size_t) -> std::vector<double>* {
      if (!isKnown(name)) return nullptr;
      const auto [column, added] = values_.try_emplace(std::string(name));
      if (!added) refuse(std::string(name), "the column is given twice", "Remove one");
      return &column->second;
    });
  }

  bool haveAll(std::span<const Name> names) const {
    return std::ranges::all_of(names, [&](Name name) { return values_.contains(name); });
  }
  void require(std::span<const Name> names, const std::string& remedy) const {
    for (Name name : names)
      if (!values_.contains(name)) refuse(name, "the column is missing", remedy);
  }
  [[noreturn]] void refuse(const std::string& column, const std::string& reason,
                           const std::string& remedy) const {
    throw base::InputError({file_, header_, column, {}, reason, remedy});
  }
  std::size_t rows() const { return values_.empty() ? 0 : values_.begin()->second.size(); }
  double at(Name name, std::size_t row) const { return values_.find(name)->second[row]; }
  std::optional<Eigen::Vector3d> point(const std::array<Name, 3>& names, std::size_t row) const {
    const Eigen::Vector3d point(at(names[0], row), at(names[1], row), at(names[2], row));
    if (!point.allFinite()) return std::nullopt;
    return point;
  }
  std::optional<StereoPixels> pixels(std::size_t row) const {
    StereoPixels seen{{at(kPixels[0], row), at(kPixels[1], row)}, {at(kPixels[2], row), at(kPixels[3], row)}};
    if (haveAll(kSigmas)) {
      seen.left_sigma = at(kSigmas[0], row);
      seen.right_sigma = at(kSigmas[1], row);
    }
    const bool whole = seen.left.allFinite() && seen.right.allFinite();
    if (!whole || !(seen.left_sigma > 0.0) || !(seen.right_sigma > 0.0)) return std::nullopt;
    return seen;
  }

 private:
  static bool isKnown(std::string_view name) {
    const auto has = [&](std::span<const Name> names) {
      return std::ranges::find(names, name) != names.end();
    };
    return has(kBase) || has(kCamera) || has(kPixels) || has(kSigmas);
  }

  std::string file_;
  int header_ = 0;
  std::map<std::string, std::vector<double>, std::less<>> values_;  // of the columns that the table has
};

}  // namespace

std::vector<PairRow> readPairTable(const NamedColumns& pairs, const NamedColumns* poses) {
  const Columns seen(pairs);
  const std::optional<Columns> others = poses ? std::optional<Columns>(*poses) : std::nullopt;
  const Columns& robot = others ? *others : seen;
  robot.require(kBase, "Give the tip's position in the base frame as x, y, z [m]");
  const bool points = seen.haveAll(kCamera);
  if (!points)
    seen.require(kPixels,
                 "Give the marker as cam_x, cam_y, cam_z [m] or as left_u, left_v, right_u, right_v [px]");
  if (robot.rows() != seen.rows())
    robot.refuse(kBase[0], fmt::format("{} rows, but {} has {}", robot.rows(), pairs.name, seen.rows()),
                 "Give one pose for each row, in the same order");
  std::vector<PairRow> rows(seen.rows());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows[row].base = robot.point(kBase, row);
    if (points)
      rows[row].camera = seen.point(kCamera, row);
    else
      rows[row].pixels = seen.pixels(row);
  }
  return rows;
}

std::vector<PairRow> readPairTable(const std::filesystem::path& pairs, const std::filesystem::path& poses) {
  const NamedColumns seen{pairs.string(), table_files::columnsIn(pairs)};
  if (poses.empty()) return readPairTable(seen, nullptr);
  const NamedColumns robot{poses.string(), table_files::columnsIn(poses)};
  return readPairTable(seen, &robot);
}

PairPoints pointsOf(const std::vector<PairRow>& rows,
                    const std::optional<vision::Triangulator>& triangulator) {
  PairPoints points;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::optional<Eigen::Vector3d> camera = rows[row].camera;
    std::string reason = rows[row].base ? "no marker" : "no tip position";
    if (rows[row].pixels && triangulator) {
      const auto& seen = *rows[row].pixels;
      const auto met = triangulator->triangulate(seen.left, seen.right, seen.left_sigma, seen.right_sigma);
      if (met.found())
        camera = met.position;
      else
        reason = fmt::format("the rays do not meet ({})", base::nameOf(met.fault));
    }
    if (rows[row].base && camera) {
      points.pairs.push_back({*camera, *rows[row].base});
      points.rows.push_back(row);
    } else {
      points.skipped.push_back({row, reason});
    }
  }
  return points;
}

std::vector<PairRow> exchanged(std::vector<PairRow> rows) {
  for (PairRow& row : rows) {
    if (!row.pixels) continue;
    std::swap(row.pixels->left, row.pixels->right);
    std::swap(row.pixels->left_sigma, row.pixels->right_sigma);
  }
  return rows;
}

bool areExchanged(const std::vector<PairRow>& rows, const vision::Triangulator& triangulator) {
  const auto meeting = [&](const PairPoints& points) { return 2 * points.pairs.size() > rows.size(); };
  const PairPoints other = pointsOf(exchanged(rows), triangulator);
  return meeting(other) && (!meeting(pointsOf(rows, triangulator)) || registerPairs(other.pairs).has_value());
}

}  // namespace capstan::registration
