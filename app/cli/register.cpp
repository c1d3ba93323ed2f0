#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/error.h"
#include "core/registration/pair_registration.h"
#include "core/table_files/read_columns.h"
#include "core/vision/registration_file.h"
#include "core/vision/rig_file.h"
#include "core/vision/triangulation.h"

namespace capstan::cli {
namespace {

struct RegisterArguments {
  std::string pairs, cameras, out, json;
};

constexpr std::array<const char*, 3> kBase = {"x", "y", "z"};
constexpr std::array<const char*, 3> kCamera = {"cam_x", "cam_y", "cam_z"};
constexpr std::array<const char*, 4> kPixels = {"left_u", "left_v", "right_u", "right_v"};

struct PairTable {
  std::vector<Eigen::Vector3d> base, camera;
};

using Column = std::vector<double>;

const char* nameOf(std::size_t index) {
  if (index < 3) return kBase[index];
  return index < 6 ? kCamera[index - 3] : kPixels[index - 6];
}

std::array<Column, 10> columnsOf(const std::string& file, const table_files::ColumnReader& reader) {
  std::array<Column, 10> columns;
  std::array<bool, 10> given{};
  reader.read([&](std::string_view name, std::size_t) -> Column* {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (name == nameOf(i)) {
        if (given[i])
          throw base::InputError({file,
                                  reader.lines.header(),
                                  std::string(name),
                                  {},
                                  "the column is given twice",
                                  "Remove one"});
        given[i] = true;
        return &columns[i];
      }
    return nullptr;
  });
  const bool points = given[3] && given[4] && given[5];
  for (std::size_t i = points ? 0 : 6; i < (points ? 3 : columns.size()); ++i)
    if (!given[i])
      throw base::InputError({file,
                              reader.lines.header(),
                              nameOf(i),
                              {},
                              "the column is missing",
                              "Give the tip as x, y, z [m] and the marker as cam_x, cam_y, cam_z [m] or as "
                              "left_u, left_v, right_u, right_v [px]"});
  for (std::size_t i = 0; i < 3; ++i)
    if (!given[i])
      throw base::InputError({file,
                              reader.lines.header(),
                              nameOf(i),
                              {},
                              "the column is missing",
                              "Give the tip's position in the base frame as x, y, z [m]"});
  if (points)
    for (std::size_t i = 6; i < columns.size(); ++i) columns[i].clear();
  return columns;
}

PairTable readPairs(const RegisterArguments& arguments) {
  const auto reader = table_files::columnsIn(arguments.pairs);
  const auto columns = columnsOf(arguments.pairs, reader);
  const bool points = !columns[3].empty();
  std::optional<vision::Triangulator> triangulator;
  if (!points) {
    if (arguments.cameras.empty())
      refuseOption("--cameras", "", "is needed for a table of pixels",
                   "Give the folder of the calibrated cameras");
    triangulator.emplace(vision::readRig(arguments.cameras));
  }
  PairTable table;
  for (std::size_t row = 0; row < columns[0].size(); ++row) {
    const auto at = [&](std::size_t column) {
      const double value = columns[column][row];
      if (!std::isfinite(value))
        throw base::InputError(reader.lines.at(arguments.pairs, row, nameOf(column), fmt::format("{}", value),
                                               "is not a finite number", "Remove the row"));
      return value;
    };
    table.base.emplace_back(at(0), at(1), at(2));
    if (points) {
      table.camera.emplace_back(at(3), at(4), at(5));
      continue;
    }
    const auto seen = triangulator->triangulate({at(6), at(7)}, {at(8), at(9)}, 1.0, 1.0);
    if (!seen.found())
      throw base::InputError(reader.lines.at(
          arguments.pairs, row, "left_u, left_v, right_u, right_v", {},
          "the rays do not meet in front of the cameras (" + std::string(base::nameOf(seen.fault)) + ")",
          "Check whether the left and the right camera are exchanged, or remove the row"));
    table.camera.push_back(seen.position);
  }
  return table;
}

[[noreturn]] void refuse(const std::string& file, const registration::PairRefusal& refusal) {
  using Fault = registration::PairFault;
  const std::string reason(base::nameOf(refusal.fault));
  switch (refusal.fault) {
    case Fault::kTooFewPairs:
      refuseFile(file, reason, "Add poses that span the workspace");
    case Fault::kCollinear:
      refuseFile(file, reason, "Add poses away from the line");
    case Fault::kMirrored:
      refuseFile(file, reason, "Check the sign of every axis, and whether left and right are exchanged");
    case Fault::kScale:
      refuseFile(file,
                 fmt::format("{}: those of the base frame are {:.4g} times as long", reason, refusal.value),
                 "Give both in metres; check the size of the calibration board's squares and the base line");
    case Fault::kNoAgreement:
      refuseFile(file, fmt::format("{} ({:.0f})", reason, refusal.value),
                 "Check that each row has the same instant and the same point of the tool in both frames");
  }
  std::abort();
}

nlohmann::json jsonOf(const registration::PairRegistration& found) {
  const Eigen::Quaterniond turn(found.base_from_camera.rotation());
  nlohmann::json rejected = nlohmann::json::array(), covariance = nlohmann::json::array();
  for (std::size_t row = 0; row < found.used.size(); ++row)
    if (!found.used[row]) rejected.push_back(row);
  for (int row = 0; row < 6; ++row) {
    const Eigen::Matrix<double, 1, 6> line = found.covariance.row(row);
    covariance.push_back(std::vector<double>(line.data(), line.data() + 6));
  }
  return {{"base_from_camera",
           {{"position", toJson(found.base_from_camera.translation())},
            {"quaternion", {turn.x(), turn.y(), turn.z(), turn.w()}}}},
          {"rms", found.rms},
          {"leave_one_out_rms", found.leave_one_out_rms},
          {"sigma", found.sigma},
          {"covariance", covariance},
          {"residuals", found.residuals},
          {"rows", found.used.size()},
          {"used", found.used.size() - rejected.size()},
          {"rejected", rejected}};
}

std::string textOf(const registration::PairRegistration& found) {
  std::string rejected;
  int used = 0;
  for (std::size_t row = 0; row < found.used.size(); ++row) {
    used += found.used[row];
    if (!found.used[row]) rejected += fmt::format("  row {}: {:.2f} mm", row, 1e3 * found.residuals[row]);
  }
  const auto& position = found.base_from_camera.translation();
  return fmt::format(
      "position       {:.3f}, {:.3f}, {:.3f} mm\npairs          {} of {}\nrms            {:.3f} mm\n"
      "leave-one-out  {:.3f} mm\nrejected     {}\n",
      1e3 * position.x(), 1e3 * position.y(), 1e3 * position.z(), used, found.used.size(), 1e3 * found.rms,
      1e3 * found.leave_one_out_rms, rejected.empty() ? "  none" : rejected);
}

ExitCode run(const RegisterArguments& arguments) {
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, {arguments.pairs});
  const PairTable table = readPairs(arguments);
  const auto found = registration::registerPairs(table.camera, table.base);
  if (!found) refuse(arguments.pairs, found.error());
  if (!arguments.out.empty()) vision::writeRegistration(found->base_from_camera, arguments.out);
  const Output output(arguments.json);
  output.text(textOf(*found));
  output.json(jsonOf(*found));
  return kOk;
}

}  // namespace

void addRegister(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<RegisterArguments>();
  CLI::App* command = app.add_subcommand("register", "Register the cameras from a table of point pairs");
  command
      ->add_option(
          "PAIRS", arguments->pairs,
          "table with the tip in the base frame (x, y, z [m]) and the marker as cam_x, cam_y, cam_z [m]\n"
          "or left_u, left_v, right_u, right_v [px]")
      ->required();
  command->add_option("--cameras", arguments->cameras,
                      "folder or file of the calibrated cameras, for pixels");
  command->add_option("--out", arguments->out, "registration file to write (.yaml)");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Rows are counted from 0, without the header. Outliers are rejected by their residuals.\n"
      "Example: capstan-cli register pairs.csv --cameras cameras --out registration.yaml");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
