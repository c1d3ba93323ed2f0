#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/detect_output.h"
#include "app/cli/outputs.h"
#include "core/base/table.h"
#include "core/base/yaml.h"
#include "core/vision/detection_overlay.h"
#include "core/vision/marker_file.h"
#include "core/vision/picture.h"
#include "core/vision/picture_markers.h"

namespace capstan::cli {
namespace {

namespace fs = std::filesystem;

struct DetectArguments {
  std::string marker, search = "frame", out, overlays, json;
  std::vector<std::string> left, right;
};

struct Row {
  std::array<std::string, 2> files;
  std::array<vision::MarkerDetection, 2> markers;

  bool found() const { return markers[0].found() && markers[1].found(); }
  std::string reason() const {
    std::string text;
    for (std::size_t side = 0; side < 2; ++side)
      if (!markers[side].found())
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", side == 0 ? "left" : "right",
                            base::nameOf(markers[side].fault));
    return text;
  }
};

// Name of a pair's overlay: numbered, because pictures of several folders may share a name.
fs::path overlayFile(const fs::path& folder, std::size_t pair, const fs::path& left) {
  return folder / fmt::format("{:03}_{}.png", pair + 1, left.stem().string());
}

void makeFolder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) refuseFile(folder, "cannot be made: " + failed.message(), "Give another --overlays");
}

std::vector<Row> detect(const DetectArguments& arguments) {
  vision::PictureMarkers finder(arguments.marker.empty() ? vision::MarkerOptions{}
                                                         : vision::readMarkerFile(arguments.marker));
  std::vector<Row> rows;
  for (std::size_t i = 0; i < arguments.left.size(); ++i) {
    Row row{{arguments.left[i], arguments.right[i]}, {}};
    const std::array<cv::Mat, 2> pictures = {vision::readPicture(row.files[0]),
                                             vision::readPicture(row.files[1])};
    row.markers = arguments.search == "frame" ? finder.inFrames(pictures) : finder.inSequence(pictures);
    if (!arguments.overlays.empty())
      vision::writePicture(vision::detectionOverlay(pictures, row.markers),
                           overlayFile(arguments.overlays, i, row.files[0]));
    rows.push_back(std::move(row));
  }
  return rows;
}

// Pixels of both or of neither: a marker in one picture is of no use to a triangulation.
base::Table tableOf(const std::vector<Row>& rows) {
  base::Table table;
  table.columns = {{"left_image", {}}, {"right_image", {}}, {"left_u", {}},      {"left_v", {}},
                   {"right_u", {}},    {"right_v", {}},     {"left_radius", {}}, {"right_radius", {}},
                   {"left_sigma", {}}, {"right_sigma", {}}, {"reason", {}}};
  for (const Row& row : rows) {
    std::vector<base::TableCell> cells = {row.files[0], row.files[1]};
    const auto& [left, right] = row.markers;
    if (row.found())
      for (double value : {left.centroid.x(), left.centroid.y(), right.centroid.x(), right.centroid.y(),
                           left.radius, right.radius, left.sigma, right.sigma})
        cells.emplace_back(value);
    cells.resize(table.columns.size() - 1);
    cells.emplace_back(row.reason());
    table.rows.push_back(std::move(cells));
  }
  return table;
}

nlohmann::json documentOf(const std::vector<Row>& rows) {
  nlohmann::json list = nlohmann::json::array();
  int detected = 0;
  for (const Row& row : rows) {
    detected += row.found();
    nlohmann::json entry = {{"left_image", row.files[0]},
                            {"right_image", row.files[1]},
                            {"detected", row.found()},
                            {"left", cli::documentOf(row.markers[0])},
                            {"right", cli::documentOf(row.markers[1])}};
    if (row.found()) {
      entry["left_u"] = row.markers[0].centroid.x();
      entry["left_v"] = row.markers[0].centroid.y();
      entry["right_u"] = row.markers[1].centroid.x();
      entry["right_v"] = row.markers[1].centroid.y();
    } else {
      entry["reason"] = row.reason();
    }
    list.push_back(entry);
  }
  return {{"pairs", rows.size()}, {"detected", detected}, {"rows", list}};
}

std::string wordsOf(const std::vector<Row>& rows) {
  std::string text;
  int detected = 0;
  for (const Row& row : rows) {
    detected += row.found();
    const auto& [left, right] = row.markers;
    text += row.found()
                ? fmt::format("{}  {:.2f}, {:.2f}  {}  {:.2f}, {:.2f}\n", row.files[0], left.centroid.x(),
                              left.centroid.y(), row.files[1], right.centroid.x(), right.centroid.y())
                : fmt::format("{}  {}  {}\n", row.files[0], row.files[1], row.reason());
  }
  return text + fmt::format("{} of {} pairs\n", detected, rows.size());
}

ExitCode run(const DetectArguments& arguments) {
  if (arguments.left.size() != arguments.right.size())
    refuseOption("--right", fmt::format("{} pictures", arguments.right.size()),
                 fmt::format("the left camera has {}", arguments.left.size()),
                 "Give one right picture for each left one, in the same order");
  std::vector<std::string> inputs = arguments.left;
  inputs.insert(inputs.end(), arguments.right.begin(), arguments.right.end());
  inputs.push_back(arguments.marker);
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, inputs);
  if (!arguments.overlays.empty()) makeFolder(arguments.overlays);
  const auto rows = detect(arguments);
  if (!arguments.out.empty()) base::writeTextFile(arguments.out, base::csvOf(tableOf(rows)));
  const Output output(arguments.json);
  output.text(wordsOf(rows));
  output.json(documentOf(rows));
  const bool any = std::ranges::any_of(rows, &Row::found);
  if (!any && arguments.marker.empty())
    notice(
        "the green ball of the simulation is in no pair. For another marker, make a marker file from one "
        "pixel "
        "(capstan-cli marker IMAGE --at U,V --out marker.yaml) and give --marker marker.yaml");
  return any ? kOk : kFailed;
}

}  // namespace

void addDetect(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* command = app.add_subcommand("detect", "Find the marker in pairs of pictures");
  command->add_option("LEFT", arguments->left, "pictures of the left camera")->required();
  command->add_option("--right", arguments->right, "pictures of the right camera, in the same order")
      ->required();
  command->add_option("--marker", arguments->marker,
                      "marker file (capstan-cli marker); default: the green ball of the simulation");
  command
      ->add_option("--search", arguments->search,
                   "frame: each whole picture; region: around the marker of the pair before, then the whole")
      ->check(CLI::IsMember({"frame", "region"}))
      ->capture_default_str();
  command->add_option("--out", arguments->out,
                      "table to write (.csv): a row a pair with left_u, left_v, right_u, right_v [px]");
  command->add_option("--overlays", arguments->overlays,
                      "folder for pictures of the detections: circle, centroid, and the marker enlarged");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Example: capstan-cli detect left*.jpg --right right*.jpg --marker marker.yaml --out centroids.csv");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
