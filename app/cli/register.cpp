#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/registration/pair_registration.h"
#include "core/registration/pair_table.h"
#include "core/vision/registration_file.h"
#include "core/vision/rig_file.h"
#include "core/vision/triangulation.h"

namespace capstan::cli {
namespace {

struct RegisterArguments {
  std::string pairs, cameras, out, json;
};

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
  std::optional<vision::Triangulator> triangulator;
  if (!arguments.cameras.empty()) triangulator.emplace(vision::readRig(arguments.cameras));
  const auto table = registration::readPairTable(arguments.pairs, triangulator);
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
