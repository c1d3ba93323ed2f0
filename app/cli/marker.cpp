#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "core/vision/marker_file.h"
#include "core/vision/pick_marker.h"
#include "core/vision/picture.h"

namespace capstan::cli {
namespace {

struct MarkerArguments {
  std::string image, out, json;
  std::vector<double> at;
};

[[noreturn]] void refusePick(const MarkerArguments& arguments, vision::PickFault fault) {
  using Fault = vision::PickFault;
  const std::string at = fmt::format("{:g},{:g}", arguments.at[0], arguments.at[1]);
  const std::string reason = fmt::format("{} in {}", base::nameOf(fault), arguments.image);
  switch (fault) {
    case Fault::kOutside:
      refuseOption("--at", at, reason, "Give a pixel of the image: column, row");
    case Fault::kNoColour:
      refuseOption("--at", at, reason, "Give a coloured pixel of the marker, not a highlight or a shadow");
    case Fault::kTooSmall:
      refuseOption("--at", at, reason, "Give a pixel of the marker, or move the camera nearer");
    case Fault::kBackground:
      refuseOption("--at", at, reason,
                   "Give a pixel of the marker; its colour must differ from the background");
  }
  std::abort();
}

std::string wordsOf(const vision::PickedMarker& picked) {
  const auto& limits = picked.options;
  std::string text = fmt::format(
      "marker      {:.2f}, {:.2f} px, radius {:.1f} px, circularity {:.2f}\nhue         {} to {}\nsaturation "
      " "
      "from {}\nvalue       from {}\nradius      from {:.1f} px\n",
      picked.mark.centroid.x(), picked.mark.centroid.y(), picked.mark.radius, picked.mark.circularity,
      limits.hue_low, limits.hue_high, limits.saturation_low, limits.value_low, limits.min_radius);
  text += fmt::format("background  {} px inside these limits, the largest area {} px\n", picked.background,
                      picked.largest_background);
  return text;
}

nlohmann::json documentOf(const vision::PickedMarker& picked) {
  nlohmann::json limits;
  vision::MarkerOptions::visit(picked.options, [&](const auto& value, const base::FieldInfo& info) {
    limits[std::string(info.key)] = value;
  });
  return {{"marker", limits},
          {"centroid", {picked.mark.centroid.x(), picked.mark.centroid.y()}},
          {"radius", picked.mark.radius},
          {"circularity", picked.mark.circularity},
          {"background", picked.background},
          {"largest_background", picked.largest_background},
          {"ambiguous", picked.ambiguous()}};
}

ExitCode run(const MarkerArguments& arguments) {
  checkOutputs({{"--out", arguments.out}, {"--json", arguments.json}}, {arguments.image});
  const cv::Mat picture = vision::readPicture(arguments.image);
  const double u = std::clamp(arguments.at[0], -1.0, 1e6), v = std::clamp(arguments.at[1], -1.0, 1e6);
  const auto picked = vision::pickMarker(
      picture, cv::Point(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v))));
  if (!picked) refusePick(arguments, picked.error());
  if (!arguments.out.empty()) vision::writeMarkerFile(picked->options, arguments.out);
  const Output output(arguments.json);
  output.text(wordsOf(*picked));
  output.json(documentOf(*picked));
  if (picked->ambiguous())
    notice(
        fmt::format("{}: another area of {} px has the marker's colour; a search of the whole image takes "
                    "neither. Cover it, or use a marker of another colour",
                    arguments.image, picked->largest_background));
  return kOk;
}

}  // namespace

void addMarker(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<MarkerArguments>();
  CLI::App* command =
      app.add_subcommand("marker", "Choose the colour limits of a marker from one pixel of a picture");
  command->add_option("IMAGE", arguments->image, "picture that shows the marker")->required();
  command->add_option("--at", arguments->at, "pixel on the marker: column,row, from 0,0 at the top left [px]")
      ->required()
      ->delimiter(',')
      ->expected(2);
  command->add_option("--out", arguments->out, "marker file to write (.yaml)");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer("Example: capstan-cli marker left01.jpg --at 346,331 --out marker.yaml");
  command->callback([arguments, &exit] { exit = run(*arguments); });
}

}  // namespace capstan::cli
