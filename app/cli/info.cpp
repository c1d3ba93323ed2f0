#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/base/yaml.h"
#include "core/recording/measured_table.h"
#include "core/recording/recording_digest.h"
#include "core/recording/recording_kinds.h"
#include "core/recording/session_file.h"
#include "core/recording/settle_units.h"
#include "core/robot/description.h"

namespace capstan::cli {
namespace {

struct InfoArguments {
  std::string file, robot, read_as, image, json;
  int size = 256;
};

/// A live session may expect joint encoders that never come.
const char* referenceOf(const recording::SessionSummary& summary) {
  if (summary.joint == 0) return summary.header.reference ? "none: no joint encoders came" : "none";
  return summary.header.own_kinematics ? "the robot's own kinematics, no truth" : "joint encoders";
}

void infoSession(const std::string& file, const Output& output) {
  const auto summary = recording::readSessionSummary(file);
  const auto& header = summary.header;
  const auto events = recording::readSessionEvents(file);
  std::string text = fmt::format("session      {}\ntitle        {}\ncreated      {}\nsoftware     {}\n", file,
                                 header.title, header.created, header.software);
  text += fmt::format("time         {:.3f} … {:.3f} s\n", summary.first_t, summary.last_t);
  text += fmt::format("rows         {} motor, {} joint, {} tip, {} frame pairs, {} estimates, {} events\n",
                      summary.motor, summary.joint, summary.tip, summary.frames, summary.estimates,
                      summary.events);
  if (summary.frames > 0) text += fmt::format("frames       {} × {} px\n", summary.width, summary.height);
  text += fmt::format("reference    {}\nregistered   {}\nsimulated    {}\nsize         {:.1f} MB\n",
                      referenceOf(summary), header.base_from_camera ? "yes" : "no",
                      header.truth.empty() ? "no" : "yes", 1e-6 * static_cast<double>(summary.bytes));
  for (const auto& event : events)
    text += fmt::format("{:>10.3f} s  {}: {}\n", event.t, event.kind, event.text);
  output.text(text);
  nlohmann::json list = nlohmann::json::array();
  for (const auto& event : events)
    list.push_back({{"t", event.t}, {"kind", event.kind}, {"text", event.text}});
  output.json({{"kind", "session"},
               {"title", header.title},
               {"created", header.created},
               {"software", header.software},
               {"first_t", summary.first_t},
               {"last_t", summary.last_t},
               {"motor", summary.motor},
               {"joint", summary.joint},
               {"tip", summary.tip},
               {"frames", summary.frames},
               {"estimates", summary.estimates},
               {"width", summary.width},
               {"height", summary.height},
               {"bytes", summary.bytes},
               {"reference", summary.joint > 0},
               {"own_kinematics", header.own_kinematics},
               {"registered", header.base_from_camera.has_value()},
               {"simulated", !header.truth.empty()},
               {"events", list}});
}

/// Writes the first left image of a session, at most `size` wide and high [px], as PNG. Throws
/// base::InputError where the session has no images.
void saveFirstImage(const std::string& session, const std::string& path, int size) {
  cv::Mat image = recording::digestOf(session, size).image;
  if (image.empty())
    throw base::InputError({session, 0, {}, {}, "has no images", "Choose a session with images for --image"});
  if (image.rows > size)
    cv::resize(image, image, {std::max(1, size * image.cols / image.rows), size}, 0.0, 0.0, cv::INTER_AREA);
  std::vector<unsigned char> png;
  cv::imencode(".png", image, png);
  base::writeTextFile(path, {png.begin(), png.end()});
}

void infoRobot(const std::string& file, const Output& output) {
  const auto robot = robot::readDescription(file);
  std::string text = fmt::format("robot        {} ({})\n{:<14}{:>10}{:>20}{:>12}{:>14}{:>14}\n", robot.name,
                                 file, "joint", "type", "limits", "r_l [mm]", "k_e [N]", "b_e [Ns/m]");
  nlohmann::json joints = nlohmann::json::array();
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const auto& joint = robot.joints[i];
    const auto& drive = robot.drives[i];
    const bool revolute = joint.type == robot::JointType::kRevolute;
    const double scale = revolute ? base::toDegrees(1.0) : base::toMillimetres(1.0);
    text +=
        fmt::format("{:<14}{:>10}{:>20}{:>12.3f}{:>14.0f}{:>14.0f}\n", joint.name, base::nameOf(joint.type),
                    fmt::format("{:.1f} … {:.1f} {}", scale * joint.limit_low, scale * joint.limit_high,
                                revolute ? "deg" : "mm"),
                    1e3 * drive.link_radius, drive.cable_stiffness, drive.cable_damping);
    joints.push_back({{"name", joint.name},
                      {"type", std::string(base::nameOf(joint.type))},
                      {"limits", {joint.limit_low, joint.limit_high}},
                      {"homing", joint.homing},
                      {"link_radius", drive.link_radius},
                      {"cable_stiffness", drive.cable_stiffness},
                      {"cable_damping", drive.cable_damping}});
  }
  output.text(text);
  output.json({{"kind", "robot"}, {"name", robot.name}, {"joints", joints}});
}

std::size_t measured(const std::vector<double>& column) {
  return static_cast<std::size_t>(
      std::count_if(column.begin(), column.end(), [](double v) { return !std::isnan(v); }));
}

/// Reads `table`. Returns its implausible units, if any; the columns are then read as SI.
std::optional<recording::ImplausibleUnits> readOrRefuse(const InfoArguments& arguments,
                                                        RecordingFormat format,
                                                        recording::MeasuredTable& table) {
  const robot::Description robot = robot::readDescriptionOrDefault(arguments.robot);
  try {
    table = readTable(arguments.file, format, robot, readAsOf(arguments.read_as));
  } catch (const recording::ImplausibleUnits& refused) {
    table = recording::readMeasuredTable(arguments.file);
    return refused;
  }
  return std::nullopt;
}

nlohmann::json documentOf(const std::optional<recording::ImplausibleUnits>& refused) {
  nlohmann::json list = nlohmann::json::array();
  if (!refused) return list;
  for (const recording::UnitFinding& found : refused->findings())
    list.push_back({{"column", found.column},
                    {"low", found.low},
                    {"high", found.high},
                    {"read_as", found.unit ? nlohmann::json(base::nameOf(*found.unit)) : nlohmann::json()},
                    {"text", found.text}});
  return list;
}

/// Prints the contents of a table. Throws recording::ImplausibleUnits after everything is printed.
void infoTable(const InfoArguments& arguments, RecordingFormat format, const Output& output) {
  const std::string& file = arguments.file;
  recording::MeasuredTable table;
  const auto refused = readOrRefuse(arguments, format, table);
  for (const std::string& line : recording::unitNotices(table)) notice(file + ": " + line);
  const double first = table.t.empty() ? 0.0 : table.t.front(), last = table.t.empty() ? 0.0 : table.t.back();
  std::string text =
      fmt::format("{:<12} {}\njoints       {}\nrows         {}\ntime         {:.3f} … {:.3f} s\n",
                  format == RecordingFormat::kRavenMotors ? "RAVEN motors" : "table", file, table.joints(),
                  table.rows(), first, last);
  nlohmann::json columns = nlohmann::json::object();
  const auto list = [&](const char* name, const recording::TableColumns& quantity) {
    for (std::size_t i = 0; i < quantity.size(); ++i) {
      const std::string key = name + std::to_string(i + 1);
      const std::size_t count = measured(quantity[i]);
      text += fmt::format("  {:<10} {:>9} values\n", key, count);
      columns[key] = count;
    }
  };
  list("q_m", table.q_m);
  list("dq_m", table.dq_m);
  list("tau_m", table.tau_m);
  list("q", table.q);
  list("p_c", table.p_c);
  list("tau_ext", table.tau_ext);
  if (table.own_kinematics) text += "  q is the robot's own kinematics, no truth\n";
  for (const auto& name : table.ignored) text += fmt::format("  {:<10}   ignored\n", name);
  output.text(text);
  output.json({{"kind", format == RecordingFormat::kRavenMotors ? "raven_motors" : "table"},
               {"joints", table.joints()},
               {"samples", table.rows()},
               {"first_t", first},
               {"last_t", last},
               {"values", columns},
               {"ignored", table.ignored},
               {"own_kinematics", table.own_kinematics},
               {"implausible_units", documentOf(refused)}});
  if (refused) throw *refused;
}

ExitCode info(const InfoArguments& arguments) {
  const Output output(arguments.json);
  checkOutputs({{"--json", arguments.json}, {"--image", arguments.image}}, {arguments.file, arguments.robot});
  const RecordingFormat format = detectFormat(arguments.file);
  if (!arguments.image.empty()) {
    if (format != RecordingFormat::kSession)
      throw base::InputError(
          {arguments.file, 0, {}, {}, "is no session", "Only sessions have a first image (--image)"});
    saveFirstImage(arguments.file, arguments.image, arguments.size);
  }
  refuseReadAs(arguments.file, format, readAsOf(arguments.read_as));
  switch (format) {
    case RecordingFormat::kSession:
      infoSession(arguments.file, output);
      break;
    case RecordingFormat::kRobot:
      infoRobot(arguments.file, output);
      break;
    default:
      infoTable(arguments, format, output);
  }
  return kOk;
}

}  // namespace

void addInfo(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command =
      app.add_subcommand("info", "Print the contents of a session, a measured table or a robot file");
  command->add_option("FILE", arguments->file, recording::recordingKinds() + ", or robot file (.yaml)")
      ->required();
  addReadAs(*command, arguments->read_as);
  command->add_option("--robot", arguments->robot,
                      "robot file whose limits are used to check the units of a table or of a RAVEN-II log\n"
                      "(default: the left RAVEN-II)");
  auto* image =
      command->add_option("--image", arguments->image, "file for the first left image of a session (PNG)");
  command->add_option("--size", arguments->size, "largest width and height of --image [px]")
      ->capture_default_str()
      ->check(CLI::Range(16, 4096))
      ->needs(image);
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli info trial.capstan\n"
      "  capstan-cli info recording.csv --json -\n"
      "  capstan-cli info trial.capstan --image first.png");
  command->callback([arguments, &exit] { exit = info(*arguments); });
}

}  // namespace capstan::cli
