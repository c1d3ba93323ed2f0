#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/register_output.h"
#include "app/cli/registrations_output.h"
#include "core/base/error.h"
#include "core/registration/pair_table.h"
#include "core/registration/pair_words.h"
#include "core/vision/registration_file.h"
#include "core/vision/rig_file.h"
#include "core/vision/triangulation.h"

namespace capstan::cli {
namespace {

struct RegisterArguments {
  std::string pairs, poses, cameras, robot, compare, history, out, json;
  bool exchange = false;
};

std::string wordsOf(const Registered& found) {
  const auto& fit = found.fit;
  std::string rejected;
  int used = 0;
  double at_points = 0.0;
  for (std::size_t i = 0; i < fit.used.size(); ++i) {
    used += fit.used[i];
    if (fit.used[i]) at_points = std::max(at_points, error95At(fit, found.points.pairs[i].camera));
    if (!fit.used[i])
      rejected += fmt::format("  row {}: {:.2f} mm", found.points.rows[i], 1e3 * fit.residuals[i]);
  }
  const Eigen::Vector3d position = 1e3 * fit.base_from_camera.translation();
  std::string text = fmt::format(
      "position       {:.3f}, {:.3f}, {:.3f} mm\npairs          {} of {}\nrms            {:.3f} mm\n"
      "leave-one-out  {:.3f} mm\n95 % error     {:.3f} mm or less at these points\nrejected     {}\n",
      position.x(), position.y(), position.z(), used, found.rows, 1e3 * fit.rms, 1e3 * fit.leave_one_out_rms,
      1e3 * at_points, rejected.empty() ? "  none" : rejected);
  for (const auto& [row, reason] : found.points.skipped)
    text += fmt::format("skipped        row {}: {}\n", row, reason);
  if (const std::string warning = registration::warningOf(fit); !warning.empty())
    text += fmt::format("note           {}\n", warning);
  return text;
}

Registered registered(const RegisterArguments& arguments) {
  std::optional<vision::Triangulator> triangulator;
  if (!arguments.cameras.empty()) triangulator.emplace(vision::readRig(arguments.cameras));
  return registerRows(registration::readPairTable(arguments.pairs, arguments.poses), triangulator,
                      arguments.exchange, arguments.pairs);
}

/// Adds the decision to the history, if there is one.
void keep(const RegisterArguments& arguments, registration::HistoryEntry entry) {
  if (arguments.history.empty()) return;
  entry.date = isoNow();
  entry.robot = robot::readDescriptionOrDefault(arguments.robot).name;
  entry.session = arguments.pairs;
  registration::addToHistory(arguments.history, entry);
}

Registered registeredOrRejected(const RegisterArguments& arguments) {
  try {
    return registered(arguments);
  } catch (const base::InputError& error) {
    registration::HistoryEntry entry;
    entry.decision = registration::Decision::kRejected;
    entry.reason = error.what();
    keep(arguments, entry);
    throw;
  }
}

ExitCode run(const RegisterArguments& arguments) {
  checkOutputs({{"--out", arguments.out}, {"--history", arguments.history}, {"--json", arguments.json}},
               {arguments.pairs, arguments.poses, arguments.compare, arguments.robot});
  std::optional<Eigen::Isometry3d> before;
  if (!arguments.compare.empty()) before = vision::readRegistration(arguments.compare);
  const Registered found = registeredOrRejected(arguments);
  const Eigen::Isometry3d& pose = found.fit.base_from_camera;
  if (!arguments.out.empty()) vision::writeRegistration(pose, arguments.out);
  keep(arguments, registration::entryOf(registration::Decision::kAccepted, found.fit));
  std::string text = wordsOf(found);
  nlohmann::json document = cli::documentOf(found);
  if (before) {
    const auto difference =
        registration::differenceOf(*before, pose, robot::readDescriptionOrDefault(arguments.robot));
    text += "difference     " + registration::wordsOf(difference) + "\n";
    document["difference"] = cli::documentOf(difference);
  }
  const Output output(arguments.json);
  output.text(text + "\n" + residualTable(found));
  output.json(document);
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
  command->add_option("--poses", arguments->poses,
                      "table with x, y, z [m] row by row, where PAIRS has only the marker");
  command->add_flag("--exchange", arguments->exchange, "take the left pixels as right and the right as left");
  command->add_option("--cameras", arguments->cameras,
                      "folder or file of the calibrated cameras, for pixels");
  command->add_option("--compare", arguments->compare,
                      "registration file in use: what changes when the new one replaces it");
  command->add_option("--history", arguments->history,
                      "history (.yaml) that gets the registration, or the reason why there is none");
  command->add_option("--robot", arguments->robot,
                      "robot file (.yaml), for the workspace of --compare and the name in the history\n"
                      "(default: the left RAVEN-II)");
  command->add_option("--out", arguments->out, "registration file to write (.yaml)");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Rows are counted from 0, without the header. Outliers are rejected by their residuals.\n"
      "Examples:\n"
      "  capstan-cli register pairs.csv --cameras cameras --out registration.yaml\n"
      "  capstan-cli register centroids.csv --poses poses.csv --cameras cameras --out registration.yaml");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
