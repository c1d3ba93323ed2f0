#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "core/base/field.h"

namespace capstan::live {

/// Motor side that sends rows of a measured table.
struct RowsSetup {
  std::string from = "tcp://127.0.0.1:5555";
  std::string read_as;
  std::array<int, 3> motors = {1, 2, 3};
  std::array<double, 3> signs = {1.0, 1.0, 1.0};
  bool reference = true;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.from, {"from", "", "- (standard input), path of a FIFO, or tcp://ADDRESS:PORT to listen on"});
    field(self.read_as, {"read_as", "", "units that are not SI, as in q_m=deg,t=ms", {}, false});
    field(self.motors,
          {"motors", "", "motor of the rows (1, 2, 3) that drives joint 1, 2, 3", {1.0, 3.0}, false});
    field(self.signs, {"signs", "", "1, or -1 for a motor that counts the other way", {-1.0, 1.0}, false});
    field(self.reference, {"reference", "", "whether columns q are joint encoders", {}, false});
  }
  bool operator==(const RowsSetup&) const = default;
};

/// A robot to connect to; files are in resources/live.
struct LiveSetup {
  std::string title;
  std::string robot;  ///< path of the robot file; empty: the left RAVEN-II
  RowsSetup motors;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.title, {"title", "", "name of the robot, shown in the window's title"});
    field(
        self.robot,
        {"robot", "", "robot file, beside this file or with its whole path; none: left RAVEN-II", {}, false});
    field(self.motors, {"motors", "", "where motor positions come from"});
  }
  bool operator==(const LiveSetup&) const = default;
};

/// Reads a live set-up; relative paths in it become paths from its folder. Throws base::InputError with file,
/// line, field, value and range.
LiveSetup readLiveSetup(const std::filesystem::path& path);
/// Set-up that `text` names: an address (isAddress()), with `robot`, or the path of a set-up file. Throws
/// base::InputError as readLiveSetup() and parseAddress(), and where a set-up file has its own robot and
/// `robot` is given, too.
LiveSetup liveSetupOf(const std::string& text, const std::string& robot, const std::string& read_as);

}  // namespace capstan::live
