#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/names.h"

namespace capstan::live {

/// Motor side: rows of a measured table as text, or messages of a ROS topic.
struct RowsSetup {
  std::string from = "tcp://127.0.0.1:5555";
  std::string read_as, encoders;
  std::vector<std::string> names;
  std::array<double, 3> zero = {0.0, 0.0, 0.0};
  int arm = 1;
  std::array<int, 3> motors = {1, 2, 3};
  std::array<double, 3> signs = {1.0, 1.0, 1.0};
  bool reference = true;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.from,
          {"from", "", "- (standard input), path of a FIFO, tcp://ADDRESS:PORT to listen on, or ros:/TOPIC"});
    field(self.read_as, {"read_as", "", "units that are not SI, as in q_m=deg,t=ms", {}, false});
    field(self.motors,
          {"motors", "", "motor of the rows (1, 2, 3) that drives joint 1, 2, 3", {1.0, 3.0}, false});
    field(self.signs, {"signs", "", "1, or -1 for a motor that counts the other way", {-1.0, 1.0}, false});
    field(self.reference, {"reference", "", "whether columns q are joint encoders", {}, false});
    field(self.encoders,
          {"encoders", "", "ROS topic (JointState) of joint encoders; left out: no", {}, false});
    field(self.names,
          {"names", "", "ROS: three names in the JointState; left out: its first three", {}, false});
    field(self.zero, {"zero", "rad", "ROS: motor positions in the message at the hard stop", {}, false});
    field(self.arm, {"arm", "", "ROS: arm of a raven_state, 1 or 2", {1.0, 2.0}, false});
  }
  bool operator==(const RowsSetup&) const = default;
};

enum class CameraLayout {
  kTwo,         ///< two streams
  kSideBySide,  ///< left | right in each image of one stream
  kTopBottom,   ///< left above right in each image of one stream
};

/// CamerasSetup::calibration of images whose topics come with camera_info.
inline constexpr const char* kRosCalibration = "ros";

/// Camera side: V4L2 devices, network streams, video files or ROS topics.
struct CamerasSetup {
  std::string left, right;
  CameraLayout layout = CameraLayout::kTwo;
  std::string calibration, registration, marker;
  double latency = 0.0, pairing = 0.012, rate = 0.0;
  int width = 0, height = 0;
  std::optional<double> exposure, gain, white_balance, focus;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.left,
          {"left", "", "device (/dev/video0), network stream (rtsp://…), video file or ros:/TOPIC"});
    field(self.right,
          {"right", "", "the same for the right camera; left out where one stream has both", {}, false});
    field(self.layout, {"layout", "", "two, side_by_side or top_bottom", {}, false});
    field(self.calibration,
          {"calibration", "",
           "ROS folder, Kalibr or OpenCV file of the cameras, or ros (camera_info beside the images)"});
    field(self.registration, {"registration", "", "registration file; left out: register first", {}, false});
    field(self.marker, {"marker", "", "marker file (colour and shape); left out: the green ball", {}, false});
    field(self.latency, {"latency",
                         "s",
                         "from exposure to arrival, or to the stamp; of a video file: by how much its first "
                         "image is earlier than the first row (negative: later)",
                         {-2.0, 2.0},
                         false});
    field(self.pairing, {"pairing", "s", "largest time between two images of a pair", {0.0, 1.0}, false});
    field(self.rate,
          {"rate", "1/s", "images per second to ask for; 0: the device's own", {0.0, 1000.0}, false});
    field(self.width, {"width", "px", "of each stream's images; 0: the device's own", {0.0, 16384.0}, false});
    field(self.height,
          {"height", "px", "of each stream's images; 0: the device's own", {0.0, 16384.0}, false});
    field(self.exposure, {"exposure", "", "in the device's units; left out: automatic", {}, false});
    field(self.gain, {"gain", "", "in the device's units; left out: as it is", {}, false});
    field(self.white_balance, {"white_balance", "K", "colour temperature; left out: automatic", {}, false});
    field(self.focus, {"focus", "", "in the device's units; left out: automatic", {}, false});
  }
  bool operator==(const CamerasSetup&) const = default;
};

/// Commands to the robot, on a ROS topic of type sensor_msgs/JointState. They are sent only where a person
/// has armed them.
struct CommandsSetup {
  std::string servo_jp, move_jp, measured;
  std::vector<std::string> names;
  std::array<double, 3> signs = {1.0, 1.0, 1.0}, offsets = {0.0, 0.0, 0.0};
  std::array<double, 3> speed = {0.1, 0.1, 0.01};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.servo_jp,
          {"servo_jp", "", "topic of set-points, as in /PSM1/servo_jp; left out: move_jp", {}, false});
    field(self.move_jp,
          {"move_jp", "", "topic of goals, as in /PSM1/move_jp; left out: servo_jp", {}, false});
    field(self.measured,
          {"measured",
           "",
           "topic of the robot's own joint positions, as in /PSM1/measured_js: a robot of more than three "
           "joints gets its other ones back; left out: three joints are sent",
           {},
           false});
    field(self.names, {"names",
                       "",
                       "three names in the message; left out: joints of the robot file, or its first three",
                       {},
                       false});
    field(self.signs, {"signs", "", "1, or -1 for a joint that counts the other way", {-1.0, 1.0}, false});
    field(self.offsets, {"offsets",
                         "rad or m",
                         "position in the message where the robot file's is 0",
                         {-100.0, 100.0},
                         false});
    field(self.speed, {"speed", "rad/s or m/s", "largest speed of joint 1, 2, 3", {1e-4, 1.0}, false});
  }
  bool operator==(const CommandsSetup&) const = default;
};

/// A robot to connect to; files are in resources/live.
struct LiveSetup {
  std::string title;
  std::string robot;  ///< path of the robot file; empty: the left RAVEN-II
  RowsSetup motors;
  std::optional<CamerasSetup> cameras;
  std::optional<CommandsSetup> commands;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.title, {"title", "", "name of the robot, shown in the window's title"});
    field(self.robot, {"robot",
                       "",
                       "robot file, beside this file or with its whole path; left out: left RAVEN-II",
                       {},
                       false});
    field(self.motors, {"motors", "", "where motor positions come from"});
    field(self.cameras, {"cameras", "", "where images come from; left out: no images", {}, false});
    field(self.commands, {"commands",
                          "",
                          "where commands go that a person has armed; left out: the robot is never moved",
                          {},
                          false});
  }
  bool operator==(const LiveSetup&) const = default;
};

/// Fields of the motor side that are given, yet are not used for its address, as "encoders".
std::vector<std::string> fieldsNotUsed(const RowsSetup& rows);
/// The set-up with relative paths of files as paths from `folder`. A path of a video file stays if there is
/// no such file in the folder.
LiveSetup resolvedFrom(LiveSetup setup, const std::filesystem::path& folder);
/// Reads a live set-up; relative paths in it become paths from its folder (resolvedFrom()). Throws
/// base::InputError with file, line, field, value and range.
LiveSetup readLiveSetup(const std::filesystem::path& path);
/// Throws base::InputError for motors or for a set-up that readLiveSetup() would refuse.
void checkMotors(const RowsSetup& motors);
void checkLiveSetup(const LiveSetup& setup);
/// Writes a set-up with every field, its unit and its meaning. Throws base::InputError for a set-up that
/// readLiveSetup() would refuse, and where the file cannot be written.
void writeLiveSetup(const LiveSetup& setup, const std::filesystem::path& path);
/// Set-up that `text` names: an address (isAddress()), with `robot`, or the path of a set-up file. Throws
/// base::InputError as readLiveSetup() and parseAddress(), with the place in the set-up file for a file named
/// there that cannot be used, and where a set-up file has its own robot and `robot` is given, too.
LiveSetup liveSetupOf(const std::string& text, const std::string& robot, const std::string& read_as);

}  // namespace capstan::live

template <>
struct capstan::base::NamesOf<capstan::live::CameraLayout> {
  using L = capstan::live::CameraLayout;
  static constexpr std::array value = {std::pair{L::kTwo, "two"}, std::pair{L::kSideBySide, "side_by_side"},
                                       std::pair{L::kTopBottom, "top_bottom"}};
};
