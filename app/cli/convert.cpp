#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/base/error.h"
#include "core/recording/export.h"
#include "core/recording/export_table.h"
#include "core/recording/recording_kinds.h"
#include "core/recording/session_file.h"
#include "core/ros1/bag_export.h"
#include "core/table_files/table_kind.h"

namespace capstan::cli {
namespace {

struct ConvertArguments {
  std::string in, out, format = "auto", to = "auto", read_as, topics, robot, json, matlab = "5";
  bool force = false;
};

std::string targetOf(const ConvertArguments& arguments) {
  if (arguments.to != "auto") return arguments.to;
  const std::string suffix = std::filesystem::path(arguments.out).extension().string();
  if (table_files::kindBySuffix(arguments.out)) return "table";
  if (suffix == recording::kSessionSuffix) return "session";
  if (suffix == ".bag") return "bag";
  if (suffix == ".avi" || suffix == ".mkv" || suffix == ".mp4") return "video";
  refuseOption("OUT", arguments.out, "has a suffix that names no format",
               "End it in " + table_files::tableSuffixes() +
                   ", .capstan, .bag, .avi, .mkv or .mp4, or give --to csv-folder or png");
}

void needSession(RecordingFormat format, const std::string& target) {
  if (format != RecordingFormat::kSession)
    refuseOption("--to", target, "needs a session as IN", "Give a .capstan file");
}

bool isHdf5(const std::string& file) {
  const table_files::TableKindFacts* kind = table_files::kindBySuffix(file);
  return kind && kind->kind == table_files::TableKind::kHdf5;
}

table_files::MatlabVersion matlabOf(const ConvertArguments& arguments) {
  return arguments.matlab == "7.3" ? table_files::MatlabVersion::k73 : table_files::MatlabVersion::k5;
}

/// Writes the table of IN to OUT and returns it.
recording::MeasuredTable tableTo(const ConvertArguments& arguments, RecordingFormat format,
                                 base::Progress& progress) {
  const bool session = format == RecordingFormat::kSession;
  if (session && isHdf5(arguments.out)) return recording::exportHdf5(arguments.in, arguments.out, &progress);
  const robot::Description robot =
      session ? recording::sessionRobot(arguments.in) : robot::readDescriptionOrDefault(arguments.robot);
  recording::MeasuredTable table = session
                                       ? recording::sessionTable(arguments.in)
                                       : readTable(arguments.in, format, robot, readAsOf(arguments.read_as));
  if (!progress.cancelled()) recording::writeTable(table, arguments.out, robot, matlabOf(arguments));
  return table;
}

std::string writeTable(const ConvertArguments& arguments, RecordingFormat format, base::Progress& progress) {
  const recording::MeasuredTable table = tableTo(arguments, format, progress);
  if (progress.cancelled()) return {};
  for (const auto& column : table.ignored)
    notice("column " + column + " is not part of a measured table: excluded");
  if (table.own_kinematics)
    notice("columns q are the robot's own kinematics, not a true reference; the table cannot state this");
  return fmt::format("{} rows of {} joints", table.rows(), table.joints());
}

std::string writeVideo(const ConvertArguments& arguments, base::Progress& progress) {
  const recording::VideoReport video = recording::exportVideo(arguments.in, arguments.out, &progress);
  if (video.other_size > 0)
    notice(fmt::format("{} frames of another size than the first are excluded: a video has one size",
                       video.other_size));
  return fmt::format("{} frames, the first {:.4f} s after the first sample", video.frames, video.begin);
}

std::unique_ptr<tracking::Source> open(const ConvertArguments& arguments, RecordingFormat format) {
  return openSource(arguments.in, format, arguments.robot, readAsOf(arguments.read_as), Notices::kSaid,
                    arguments.topics);
}

std::string writeBag(const ConvertArguments& arguments, RecordingFormat format, base::Progress& progress) {
  const auto session = format == RecordingFormat::kSession ? recording::readSessionSummary(arguments.in)
                                                           : recording::SessionSummary();
  const ros1::BagReport bag = ros1::exportBag(*open(arguments, format), arguments.out,
                                              secondsOfIso(session.header.created), &progress);
  if (session.events > 0)
    notice(
        fmt::format("{} events of the session are excluded: a bag has no topic for them; --to csv-folder "
                    "writes them",
                    session.events));
  return fmt::format("{} motor samples, {} joint samples, {} tips, {} images", bag.motors, bag.joints,
                     bag.tips, bag.images);
}

/// Writes OUT and returns the amount written as text, which is meaningless once `progress` is cancelled.
std::string convertTo(const std::string& target, const ConvertArguments& arguments, RecordingFormat format,
                      base::Progress& progress) {
  if (target == "table") return writeTable(arguments, format, progress);
  if (target == "session") {
    const auto source = open(arguments, format);
    recording::importRecording(
        *source, arguments.out, recording::headerOf(source->info(), isoNow()), &progress,
        arguments.force ? recording::Existing::kReplace : recording::Existing::kRefuse);
    if (progress.cancelled()) return {};
    return fmt::format("{} motor samples", recording::readSessionSummary(arguments.out).motor);
  }
  if (target == "bag") return writeBag(arguments, format, progress);
  needSession(format, target);
  if (target == "csv-folder")
    return fmt::format("{} files", recording::exportCsv(arguments.in, arguments.out, &progress).size());
  if (target == "png")
    return fmt::format("{} images", recording::exportPng(arguments.in, arguments.out, &progress));
  return writeVideo(arguments, progress);
}

/// Checks that OUT and --json can be written. Throws base::InputError.
void checkOut(const ConvertArguments& arguments, const std::string& target) {
  namespace fs = std::filesystem;
  const std::vector<std::string> inputs = {arguments.in, arguments.robot};
  if (target == "csv-folder" || target == "png") {
    checkOutputFolder("OUT", arguments.out, {}, inputs);
    if (!arguments.force && fs::is_directory(arguments.out) && !fs::is_empty(arguments.out))
      refuseFile(arguments.out, "is not empty", "Give another folder, or add --force to write into this one");
    checkOutputs({{"--json", arguments.json}}, inputs);
    return;
  }
  checkOutputs({{"OUT", arguments.out}, {"--json", arguments.json}}, inputs);
  if (!arguments.force) refuseExisting("OUT", arguments.out);
}

ExitCode convert(const ConvertArguments& arguments) {
  const Output output(arguments.json);
  const RecordingFormat format = formatOf(arguments.format, arguments.in);
  if (format == RecordingFormat::kRobot)
    refuseFile(arguments.in, "is no recording", "Give a session or a table");
  refuseReadAs(arguments.in, format, readAsOf(arguments.read_as));
  const std::string target = targetOf(arguments);
  checkOut(arguments, target);
  base::Progress progress;
  std::string written;
  {
    const ProgressLine line(progress);
    written = convertTo(target, arguments, format, progress);
  }
  if (progress.cancelled()) {
    notice("cancelled");
    return kFailed;
  }
  output.text(fmt::format("{}: {}\n", arguments.out, written));
  output.json({{"in", arguments.in}, {"out", arguments.out}, {"to", target}, {"written", written}});
  return kOk;
}

}  // namespace

void addConvert(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = app.add_subcommand(
      "convert", "Convert sessions to tables, ROS bags, images or videos, and these to sessions");
  command->add_option("IN", arguments->in, recording::recordingKinds())->required();
  command->add_option("OUT", arguments->out, "file or folder to write")->required();
  command
      ->add_option("--to", arguments->to,
                   "format of OUT: auto (by its suffix: " + table_files::tableSuffixes() +
                       " is a table), table, session, bag,\ncsv-folder, png, video")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "table", "session", "bag", "csv-folder", "png", "video"}));
  command->add_option("--format", arguments->format, "format of IN: auto, session, table, raven")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "session", "table", "raven"}));
  addReadAs(*command, arguments->read_as);
  addTopics(*command, arguments->topics);
  command->add_option("--robot", arguments->robot, "robot file, for recordings that contain none");
  command->add_option("--matlab", arguments->matlab, "version of a MATLAB file as OUT: 5 or 7.3")
      ->capture_default_str()
      ->check(CLI::IsMember({"5", "7.3"}));
  command->add_flag("--force", arguments->force,
                    "overwrite an existing file, or write into a folder that is not empty");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan-cli convert trial.capstan trial.csv              (measured table)\n"
      "  capstan-cli convert trial.capstan trial.h5               (HDF5: table, and rows of every sensor)\n"
      "  capstan-cli convert trial.capstan trial.mat              (MATLAB, Octave, SciPy)\n"
      "  capstan-cli convert trial.h5 trial.jsonl                 (JSON Lines)\n"
      "  capstan-cli convert trial.capstan tables/ --to csv-folder\n"
      "  capstan-cli convert trial.capstan frames/ --to png\n"
      "  capstan-cli convert trial.capstan trial.mkv              (both views side by side)\n"
      "  capstan-cli convert trial.capstan trial.bag              (for rosbag play)\n"
      "  capstan-cli convert trial.bag trial.capstan\n"
      "  capstan-cli convert joints123.csv table.csv              (RAVEN-II motor log to SI)\n"
      "  capstan-cli convert degrees.csv si.csv --read-as q_m=deg,q1=deg,q2=deg\n"
      "  capstan-cli convert recording.csv recording.capstan");
  command->callback([arguments, &exit] { exit = convert(*arguments); });
}

}  // namespace capstan::cli
