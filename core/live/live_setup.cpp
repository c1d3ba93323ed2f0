#include "core/live/live_setup.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/base/yaml_line.h"
#include "core/live/streams/address.h"
#include "core/recording/column_units.h"
#include "core/robot/description.h"
#include "core/vision/marker_file.h"
#include "core/vision/registration_file.h"
#include "core/vision/rig_file.h"

namespace capstan::live {
namespace {

[[noreturn]] void refuse(const std::string& file, const char* field, const std::string& value,
                         const std::string& reason, const std::string& remedy) {
  throw base::InputError({file, 0, field, value, reason, remedy});
}

bool isTopicName(const std::string& text) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '/'; };
  return text.size() > 1 && text.front() == '/' && std::ranges::all_of(text, fits);
}

void checkTopic(const std::string& file, const char* field, const std::string& topic) {
  if (isRosTopic(topic)) refuse(file, field, topic, "is no name of a ROS topic", "Write it without ros:");
  if (!isTopicName(topic))
    refuse(file, field, topic, "is no name of a ROS topic",
           "Begin it with / and use letters, digits, _ and /");
}

void checkTopics(const LiveSetup& setup, const std::string& file) {
  const auto check = [&](const char* field, const std::string& address) {
    if (isRosTopic(address) && !isTopicName(rosTopicOf(address)))
      refuse(file, field, address, "names no ROS topic", "Write ros:/TOPIC with letters, digits, _ and /");
  };
  check("motors.from", setup.motors.from);
  if (!setup.motors.encoders.empty()) checkTopic(file, "motors.encoders", setup.motors.encoders);
  if (isRosTopic(setup.motors.from) && setup.motors.encoders == rosTopicOf(setup.motors.from))
    refuse(file, "motors.encoders", setup.motors.encoders, "is the topic of the motors",
           "Name the topic of the joint encoders, or leave it out");
  if (!setup.cameras) return;
  check("cameras.left", setup.cameras->left);
  check("cameras.right", setup.cameras->right);
}

void checkRos(const LiveSetup& setup, const std::string& file) {
  checkTopics(setup, file);
  if (!setup.motors.names.empty() && setup.motors.names.size() != 3)
    refuse(file, "motors.names", std::to_string(setup.motors.names.size()) + " names", "are not three",
           "Give the names of the three motors of the arm, or none");
  const CamerasSetup* cameras = setup.cameras ? &*setup.cameras : nullptr;
  if (cameras && cameras->calibration.empty())
    refuse(file, "cameras.calibration", "", "is missing",
           "Give the folder or the file of a calibration: " + vision::rigFileKinds() +
               "; for ROS topics that have a camera_info also ros");
  if (cameras && cameras->calibration == kRosCalibration &&
      !(isRosTopic(cameras->left) && isRosTopic(cameras->right)))
    refuse(file, "cameras.calibration", cameras->calibration, "needs images from two ROS topics",
           "Give the folder or the file of a calibration");
}

void checkCommands(const CommandsSetup& commands, const std::string& file) {
  if (commands.servo_jp.empty() == commands.move_jp.empty())
    refuse(file, "commands.servo_jp", commands.servo_jp, "and move_jp: exactly one of the two is to be given",
           "Give the topic that your robot takes set-points from");
  const std::pair<const char*, const std::string*> topics[] = {{"commands.servo_jp", &commands.servo_jp},
                                                               {"commands.move_jp", &commands.move_jp},
                                                               {"commands.measured", &commands.measured}};
  for (const auto& [field, topic] : topics)
    if (!topic->empty()) checkTopic(file, field, *topic);
  if (!commands.names.empty() && commands.names.size() != 3)
    refuse(file, "commands.names", std::to_string(commands.names.size()) + " names", "are not three",
           "Give the names of the three joints of the arm, or none");
  for (const double sign : commands.signs)
    if (std::abs(sign) != 1.0)
      refuse(file, "commands.signs", base::yamlText(sign), "is no sign", "Give 1 or -1");
}

void checkMotors(const RowsSetup& rows, const std::string& file) {
  std::array<int, 3> sorted = rows.motors;
  std::ranges::sort(sorted);
  if (sorted != std::array{1, 2, 3})
    refuse(file, "motors.motors",
           std::to_string(rows.motors[0]) + ", " + std::to_string(rows.motors[1]) + ", " +
               std::to_string(rows.motors[2]),
           "names a motor twice", "Give each of 1, 2 and 3 once");
  for (const double sign : rows.signs)
    if (std::abs(sign) != 1.0)
      refuse(file, "motors.signs", base::yamlText(sign), "is no sign", "Give 1 or -1");
  parseAddress(rows.from, "motors.from");
  recording::parseReadAs(rows.read_as, "motors.read_as");
}

void check(const LiveSetup& setup, const std::string& file) {
  checkMotors(setup.motors, file);
  checkRos(setup, file);
  if (setup.commands) checkCommands(*setup.commands, file);
  if (setup.cameras && setup.cameras->left.empty())
    refuse(file, "cameras.left", setup.cameras->left, "names no camera",
           "Give a device, a file, an address or ros:/TOPIC");
  if (setup.cameras && (setup.cameras->layout == CameraLayout::kTwo) == setup.cameras->right.empty())
    refuse(file, "cameras.right", setup.cameras->right, "does not fit the layout",
           "Give two streams for the layout two, one (as left) for side_by_side and top_bottom");
  if (setup.cameras && setup.cameras->left == setup.cameras->right)
    refuse(
        file, "cameras.right", setup.cameras->right, "is the left camera, too",
        "Give the other camera, or, where one stream has both images, the layout side_by_side or top_bottom");
}

/// Whether `text` is HOST:PORT, an address without tcp://.
bool isBareAddress(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size() ||
      text.find('/') != std::string::npos)
    return false;
  return std::all_of(text.begin() + static_cast<std::ptrdiff_t>(colon) + 1, text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Throws base::InputError for a text that is no set-up file, where it is known what was meant.
void refuseOtherKind(const std::string& text) {
  if (!std::filesystem::exists(text) && isBareAddress(text))
    refuse({}, "--live", text, "is no file", "Write tcp://" + text + " to listen at this address");
  if (text.find("://") != std::string::npos)
    refuse({}, "--live", text, "is no address of rows",
           "Give tcp://ADDRESS:PORT, ros:/TOPIC, or a live set-up file, which may name cameras");
  if (std::filesystem::path(text).extension() == ".capstan")
    refuse({}, "--live", text, "is a recording", "Track it as a FILE, without --live");
}

bool isFifo(const std::string& path) { return std::filesystem::is_fifo(path); }

/// Returns work(). An InputError that names no file, or `file` without a line, is rethrown with file and
/// line.
template <class Work>
void namingLine(const std::string& text, const std::string& file, Work&& work) {
  try {
    work();
  } catch (const base::InputError& error) {
    base::InputFault fault = error.fault();
    if (fault.line > 0 || (!fault.file.empty() && fault.file != file)) throw;
    fault.file = file;
    fault.line = base::yamlLine(text, file, fault.key);
    throw base::InputError(std::move(fault));
  }
}

/// Reads every file that the set-up names; `path`: of the set-up file. Throws base::InputError with the
/// set-up's file, line and field where one of them cannot be used.
void checkNamedFiles(const LiveSetup& setup, const std::filesystem::path& path) {
  const auto read = [&](const char* field, const std::string& named, const auto& reader) {
    if (named.empty()) return;
    try {
      reader(named);
    } catch (const base::InputError& error) {
      const std::string file = path.string();
      throw base::InputError({file, base::yamlLine(base::readYamlTextFile(path), file, field), field, named,
                              "cannot be used", error.what()});
    }
  };
  read("motors.from", isAddress(setup.motors.from) ? std::string() : setup.motors.from,
       [](const std::string& named) {
         if (std::filesystem::exists(named)) return;
         if (isBareAddress(named)) refuse({}, "", "", "is no file", "Write tcp://" + named);
         refuse({}, "", "", "is neither an address nor a file or FIFO that exists",
                "Give tcp://ADDRESS:PORT");
       });
  read("robot", setup.robot, [](const std::string& file) { robot::readDescription(file); });
  if (!setup.cameras) return;
  const CamerasSetup& cameras = *setup.cameras;
  if (cameras.calibration != kRosCalibration)
    read("cameras.calibration", cameras.calibration, [](const std::string& file) { vision::readRig(file); });
  read("cameras.registration", cameras.registration,
       [](const std::string& file) { vision::readRegistration(file); });
  read("cameras.marker", cameras.marker, [](const std::string& file) { vision::readMarkerFile(file); });
}

}  // namespace

LiveSetup readLiveSetup(const std::filesystem::path& path) {
  const std::string text = base::readYamlTextFile(path), file = path.string();
  auto setup = base::readYaml<LiveSetup>(text, file);
  namingLine(text, file, [&] { check(setup, file); });
  return resolvedFrom(std::move(setup), path.parent_path());
}

std::vector<std::string> fieldsNotUsed(const RowsSetup& rows) {
  const RowsSetup defaults;
  std::vector<std::string> unused;
  const auto add = [&](const char* field, bool given) {
    if (given) unused.emplace_back(field);
  };
  if (isRosTopic(rows.from)) {
    add("read_as", !rows.read_as.empty());
    return unused;
  }
  add("encoders", !rows.encoders.empty());
  add("names", !rows.names.empty());
  add("zero", rows.zero != defaults.zero);
  add("arm", rows.arm != defaults.arm);
  return unused;
}

LiveSetup resolvedFrom(LiveSetup setup, const std::filesystem::path& folder) {
  const auto beside = [&](std::string& file) {
    if (!file.empty()) file = (folder / file).string();
  };
  beside(setup.robot);
  if (!setup.cameras) return setup;
  CamerasSetup& cameras = *setup.cameras;
  if (cameras.calibration != kRosCalibration) beside(cameras.calibration);
  beside(cameras.registration);
  beside(cameras.marker);
  // A video file, and no address or device, if it is there.
  for (std::string* stream : {&cameras.left, &cameras.right}) {
    std::error_code none;  // an address may be no path at all
    if (std::filesystem::is_regular_file(folder / *stream, none)) beside(*stream);
  }
  return setup;
}

void checkMotors(const RowsSetup& motors) { checkMotors(motors, {}); }

void checkLiveSetup(const LiveSetup& setup) { check(setup, {}); }

void writeLiveSetup(const LiveSetup& setup, const std::filesystem::path& path) {
  check(setup, {});
  base::writeTextFile(path, base::writeYaml(setup));
}

LiveSetup liveSetupOf(const std::string& text, const std::string& robot, const std::string& read_as) {
  if (isAddress(text) || isFifo(text)) {
    LiveSetup setup{.title = text == "-" ? "standard input" : text,
                    .robot = robot,
                    .motors = {},
                    .cameras = {},
                    .commands = {}};
    setup.motors.from = text, setup.motors.read_as = read_as;
    check(setup, {});
    return setup;
  }
  refuseOtherKind(text);
  LiveSetup setup = readLiveSetup(text);
  checkNamedFiles(setup, text);
  if (!robot.empty() && !setup.robot.empty())
    refuse({}, "--robot", robot, "is given, yet " + text + " names a robot, too", "Leave it out");
  if (!read_as.empty())
    refuse({}, "--read-as", read_as, "is given together with a set-up file", "Write it there, as read_as");
  if (!robot.empty()) setup.robot = robot;
  return setup;
}

}  // namespace capstan::live
