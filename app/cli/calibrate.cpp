#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <string>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/base/error.h"
#include "core/base/names.h"
#include "core/vision/calibration.h"
#include "core/vision/rig_file.h"

namespace capstan::cli {
namespace {

constexpr const char* kOpenCv = "stereo.yml";
constexpr const char* kLeft = "left.yaml";
constexpr const char* kRight = "right.yaml";

struct CalibrateArguments {
  std::string folder, out = ".", kind = "chessboard", dictionary = "4x4", board = "9x6", json;
  double square_mm = 25.0, marker_mm = 18.0;
  bool write = true, force = false, opencv = false;
  vision::CalibrationOptions options;
};

void parseBoard(const std::string& text, vision::CalibrationOptions& options) {
  int columns = 0, rows = 0, used = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &columns, &rows, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || columns < 3 || rows < 3 || columns > 50 || rows > 50)
    refuseOption("--board", text, "is not COLUMNSxROWS of inner corners, 3 to 50 each",
                 "Give, for example, --board 9x6");
  options.board_columns = columns;
  options.board_rows = rows;
}

std::string coverageText(const vision::BoardCoverage& coverage) {
  const std::vector<std::string> missing = coverage.missing();
  return fmt::format("across {:.0f} %, down {:.0f} %, size {:.0f} %, tilt {:.0f} %{}{}", 100.0 * coverage.x,
                     100.0 * coverage.y, 100.0 * coverage.size, 100.0 * coverage.skew,
                     missing.empty() ? "" : "; missing: ", fmt::join(missing, ", "));
}

std::string wordsOf(const vision::CalibrationReport& report) {
  const auto& left = report.rig.left;
  const auto& right = report.rig.right;
  std::string text = fmt::format("{:<28}{:>12}{:>12}\n", "", "left", "right");
  text += fmt::format("{:<28}{:>12.2f}{:>12.2f}\n", "focal length fx [px]", left.fx, right.fx);
  text += fmt::format("{:<28}{:>12.2f}{:>12.2f}\n", "  its standard deviation", report.left.focal_sigma,
                      report.right.focal_sigma);
  text += fmt::format("{:<28}{:>12.2f}{:>12.2f}\n", "principal point cx [px]", left.cx, right.cx);
  text += fmt::format("{:<28}{:>12.2f}{:>12.2f}\n", "principal point cy [px]", left.cy, right.cy);
  text +=
      fmt::format("{:<28}{:>12.4f}{:>12.4f}\n", "reprojection RMS [px]", report.left.rms, report.right.rms);
  text += fmt::format("{:<28}{:>12.4f}\n", "stereo RMS [px]", report.stereo_rms);
  text += fmt::format("{:<28}{:>12.4f}\n", "epipolar RMS [px]", report.epipolar_rms);
  text += fmt::format("{:<28}{:>12.3f}\n", "baseline [mm]", 1e3 * report.rig.baseline());
  text += fmt::format("coverage left   {}\n", coverageText(report.left_coverage));
  text += fmt::format("coverage right  {}\n\n", coverageText(report.right_coverage));
  text += fmt::format("{:<28}{:>12}{:>12}{:>12}{:>12}\n", "view (RMS in px)", "left", "right", "stereo",
                      "epipolar");
  for (const auto& view : report.views) {
    if (view.used())
      text += fmt::format("{:<28}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{}\n", view.left + " " + view.right,
                          view.left_error, view.right_error, view.stereo_error, view.epipolar_error,
                          view.outlying ? "  outlier" : "");
    else
      text += fmt::format("{:<28}  rejected: {}\n", view.left + " " + view.right, base::nameOf(view.fault));
  }
  text += fmt::format("\n{} of {} pairs used\n", report.views_used, report.views.size());
  return text;
}

nlohmann::json cameraJson(const vision::Camera& camera, const vision::CameraCalibration& fit) {
  return {{"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"rms", fit.rms},
          {"fx_sigma", fit.focal_sigma},
          {"distortion", camera.distortion},
          {"centre_sigma", fit.centre_sigma}};
}

nlohmann::json coverageJson(const vision::BoardCoverage& coverage) {
  return {{"x", coverage.x},
          {"y", coverage.y},
          {"size", coverage.size},
          {"skew", coverage.skew},
          {"missing", coverage.missing()}};
}

nlohmann::json documentOf(const vision::CalibrationReport& report) {
  nlohmann::json views = nlohmann::json::array();
  for (const auto& view : report.views)
    views.push_back({{"left", view.left},
                     {"right", view.right},
                     {"used", view.used()},
                     {"reason", std::string(base::nameOf(view.fault))},
                     {"outlier", view.outlying},
                     {"left_rms", view.left_error},
                     {"right_rms", view.right_error},
                     {"stereo_rms", view.stereo_error},
                     {"epipolar_rms", view.epipolar_error}});
  return {{"left", cameraJson(report.rig.left, report.left)},
          {"right", cameraJson(report.rig.right, report.right)},
          {"stereo_rms", report.stereo_rms},
          {"epipolar_rms", report.epipolar_rms},
          {"coverage",
           {{"left", coverageJson(report.left_coverage)}, {"right", coverageJson(report.right_coverage)}}},
          {"baseline", report.rig.baseline()},
          {"views_used", report.views_used},
          {"other_board", report.other_board[0] > 0 ? nlohmann::json(report.other_board) : nlohmann::json()},
          {"views", views}};
}

/// Checks that the outputs can be written, before the long computation. Throws base::InputError.
void checkOut(const CalibrateArguments& arguments, const vision::CalibrationInput& pairs) {
  std::vector<std::string> inputs;
  for (const auto* side : {&pairs.left, &pairs.right})
    for (const auto& image : *side) inputs.push_back(image.string());
  checkOutputs({{"--json", arguments.json}}, inputs);
  if (!arguments.write) return;
  std::vector<std::string> names = {kLeft, kRight};
  if (arguments.opencv) names.emplace_back(kOpenCv);
  checkOutputFolder("--out", arguments.out, names, inputs);
  for (const std::string& name : names)
    if (!arguments.force) refuseExisting("--out", std::filesystem::path(arguments.out) / name);
}

ExitCode calibrate(CalibrateArguments& arguments) {
  parseBoard(arguments.board, arguments.options);
  arguments.options.square_size = 1e-3 * arguments.square_mm;
  arguments.options.marker_size = 1e-3 * arguments.marker_mm;
  arguments.options.board = *base::fromName<vision::BoardKind>(arguments.kind);
  arguments.options.dictionary = *base::fromName<vision::BoardDictionary>(arguments.dictionary);
  const Output output(arguments.json);
  const auto pairs = vision::findStereoPairs(arguments.folder);
  checkOut(arguments, pairs);
  base::Progress progress;
  vision::CalibrationReport report;
  {
    const ProgressLine line(progress);
    report = vision::calibrateStereo(pairs, arguments.options, progress);
  }
  if (report.cancelled) {
    notice("cancelled");
    return kFailed;
  }
  if (const auto& other = report.other_board; other[0] > 0)
    notice(
        fmt::format("the images show a chessboard of {}x{} inner corners, not {}: part of it was used; give "
                    "--board {}x{}",
                    other[0], other[1], arguments.board, other[0], other[1]));
  output.text(wordsOf(report));
  output.json(documentOf(report));
  if (arguments.write) {
    const std::filesystem::path folder = arguments.out;
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) refuseFile(folder.string(), failed.message(), "Give another --out");
    vision::writeStereoRig(report.rig, folder / kLeft, folder / kRight);
    output.text(fmt::format("wrote {} and {}\n", (folder / kLeft).string(), (folder / kRight).string()));
    if (arguments.opencv) {
      vision::writeOpenCvRig(report.rig, folder / kOpenCv);
      output.text(fmt::format("wrote {}\n", (folder / kOpenCv).string()));
    }
  }
  return kOk;
}

}  // namespace

void addCalibrate(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App* command = app.add_subcommand("calibrate", "Calibrate a stereo camera from images of a board");
  command->add_option("FOLDER", arguments->folder, "folder with left*.png|jpg… and right*.png|jpg…")
      ->required();
  command
      ->add_option("--kind", arguments->kind,
                   "board: chessboard; charuco (chessboard with markers, also seen in part); aruco (grid of\n"
                   "markers)")
      ->capture_default_str()
      ->check(CLI::IsMember({"chessboard", "charuco", "aruco"}));
  command
      ->add_option("--board", arguments->board,
                   "number of inner corners, COLUMNSxROWS; of an aruco board, of markers")
      ->capture_default_str();
  command
      ->add_option("--square-mm", arguments->square_mm,
                   "side of a square; of an aruco board, from marker to marker [mm]")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  command->add_option("--marker-mm", arguments->marker_mm, "side of a marker [mm]")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 1000.0));
  command
      ->add_option("--dictionary", arguments->dictionary,
                   "family of the markers: 4x4, 5x5, 6x6, original, apriltag_36h11")
      ->capture_default_str()
      ->check(CLI::IsMember({"4x4", "5x5", "6x6", "original", "apriltag_36h11"}));
  command
      ->add_option("--outlier-factor", arguments->options.outlier_factor,
                   "exclude views whose error exceeds this multiple of the median error; 0: keep all")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 100.0));
  command->add_option("--out", arguments->out, "folder for left.yaml and right.yaml (ROS camera_info)")
      ->capture_default_str();
  command->add_flag("--force", arguments->force, "overwrite existing files");
  command->add_flag("--opencv", arguments->opencv, "also write stereo.yml for OpenCV: M1, D1, M2, D2, R, T");
  command->add_flag_callback(
      "--no-write", [arguments] { arguments->write = false; }, "print the result, write no file");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli calibrate pictures/ --board 9x6 --square-mm 25 --out cameras/\n"
      "  capstan-cli calibrate pictures/ --kind charuco --board 11x7 --square-mm 20 --marker-mm 15\n"
      "  capstan-cli calibrate pictures/ --no-write --json -");
  command->callback([arguments, &exit] { exit = calibrate(*arguments); });
}

}  // namespace capstan::cli
