#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "app/cli/command.h"
#include "app/cli/console.h"
#include "app/cli/outputs.h"
#include "app/cli/recordings.h"
#include "core/live/player.h"
#include "core/live/ros_player.h"
#include "core/recording/export.h"
#include "core/recording/recording_kinds.h"
#include "core/recording/session_file.h"
#include "core/recording/session_source.h"

namespace capstan::cli {
namespace {

struct PlayArguments {
  std::string file, to, video, robot, read_as, json;
  double speed = 1.0, wait = 30.0;
  unsigned seed = 1;
  std::vector<std::string> faults, video_faults;
  bool wait_for_images = false;
};

struct RowPlay {
  live::Address to;
  live::PlayOptions options;
};
struct ImagePlay {
  live::HttpAddress at;
  live::PlayOptions options;
};

live::PlayOptions optionsOf(const std::vector<std::string>& faults, unsigned seed, const std::string& option,
                            live::PlayFault (*parse)(const std::string&, const std::string&)) {
  live::PlayOptions options{.faults = {}, .seed = seed, .keep_on = false};
  for (const std::string& text : faults) options.faults.push_back(parse(text, option));
  return options;
}

constexpr const char* kRos = "ros";

std::optional<RowPlay> rowPlayOf(const PlayArguments& arguments) {
  if (arguments.to.empty()) {
    if (!arguments.faults.empty())
      refuseOption("--fault", arguments.faults.front(), "needs --to", "Give --to, or --video-fault");
    return {};
  }
  const live::Address to = live::parseAddress(arguments.to, "--to");
  if (arguments.to == kRos)
    return RowPlay{{}, optionsOf(arguments.faults, arguments.seed, "--fault", live::parseRowFault)};
  if (to.kind != live::Address::Kind::kTcp || to.port == 0)
    refuseOption("--to", arguments.to, "is no TCP address", "Give one as in tcp://127.0.0.1:5555, or ros");
  return RowPlay{to, optionsOf(arguments.faults, arguments.seed, "--fault", live::parseRowFault)};
}

std::optional<ImagePlay> imagePlayOf(const PlayArguments& arguments) {
  if (arguments.to == kRos && !arguments.video.empty())
    refuseOption("--video", arguments.video, "is given, yet --to ros publishes the images, too",
                 "Leave it out");
  if (arguments.video.empty()) {
    if (!arguments.video_faults.empty() && arguments.to != kRos)
      refuseOption("--video-fault", arguments.video_faults.front(), "needs --video", "Give --video");
    return {};
  }
  if (arguments.speed == 0.0)
    refuseOption("--speed", "0", "is not possible with --video: no receiver of images asks for the next one",
                 "Give a speed above 0");
  return ImagePlay{live::parseHttpAddress(arguments.video, "--video"),
                   optionsOf(arguments.video_faults, arguments.seed, "--video-fault", live::parseImageFault)};
}

void checkImages(const std::string& file, RecordingFormat format) {
  if (format != RecordingFormat::kSession || recording::readSessionSummary(file).frames == 0)
    refuseFile(file, "contains no images", "Give a session that was recorded with cameras");
}

recording::MeasuredTable rowsOf(const PlayArguments& arguments, RecordingFormat format) {
  return format == RecordingFormat::kSession
             ? recording::sessionTable(arguments.file)
             : readTable(arguments.file, format, robot::readDescriptionOrDefault(arguments.robot),
                         readAsOf(arguments.read_as));
}

struct Played {
  std::optional<live::PlayReport> rows;
  std::optional<live::ImagePlayReport> images;
  double started = 0.0;  ///< time since 1970 at which the first row was due [s]
};

/// Connects to the receiver of the rows as soon as it listens. Null: the user has cancelled. Throws
/// base::InputError where nothing listens within --wait.
std::unique_ptr<live::TcpSender> waitForReceiver(const live::Address& to, const PlayArguments& arguments,
                                                 const base::Progress& progress) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPause{100};  // between two attempts
  const auto end = Clock::now() + std::chrono::duration<double>(arguments.wait);
  for (bool said = false; !progress.cancelled(); std::this_thread::sleep_for(kPause)) {
    try {
      return std::make_unique<live::TcpSender>(to);
    } catch (const base::InputError&) {
      if (Clock::now() >= end) throw;
    }
    if (!std::exchange(said, true)) notice("waiting for a program that listens at " + arguments.to);
  }
  return nullptr;
}

/// Sends rows, images or both, on one clock.
Played playBoth(const PlayArguments& arguments, const std::optional<RowPlay>& rows,
                const std::optional<ImagePlay>& images, const recording::MeasuredTable& table,
                base::Progress& progress) {
  std::optional<live::ImageServer> server;
  if (images) {
    server.emplace(images->at.host, images->at.port);
    const std::string at = fmt::format("http://{}:{}", images->at.host, server->port());
    notice(fmt::format("images at {0}/left, {0}/right and, side by side, {0}/both", at));
  }
  std::optional<recording::SessionSource> pairs;
  if (images) pairs.emplace(arguments.file);
  auto receiver = rows ? waitForReceiver(rows->to, arguments, progress) : nullptr;
  if (rows && !receiver) return {};
  const live::PlayClock clock{.begin = table.t.front(), .speed = arguments.speed};
  std::future<live::ImagePlayReport> served;
  if (images)
    served = std::async(std::launch::async,
                        [&] { return live::playImages(*pairs, *server, clock, images->options, &progress); });
  Played played;
  played.started = clock.started;
  try {
    if (receiver) {
      live::PlayOptions options = rows->options;
      options.keep_on = images.has_value();
      played.rows = live::playRows(table, std::move(receiver), clock, options, &progress);
    }
  } catch (...) {
    progress.cancel();  // the images end, too
    throw;
  }
  if (served.valid()) played.images = served.get();
  return played;
}

/// Waits until the receiver has subscribed: to the motors, and to the images where --wait-for-images says so;
/// else these get a moment, since a receiver that wants them subscribes to all topics at once. False: the
/// user has cancelled. Throws base::InputError where nobody has subscribed.
bool waitForSubscribers(const live::RosPlayer& player, bool images, const PlayArguments& arguments,
                        base::Progress& progress) {
  using Topics = live::RosPlayer::Topics;
  const bool wait_for_images = arguments.wait_for_images;
  const std::chrono::milliseconds patience(std::llround(1e3 * arguments.wait));
  constexpr std::chrono::seconds kMoment{1};
  const auto wait = [&](Topics topics, const char* what) {
    if (player.waitForSubscribers(topics, patience, &progress)) return true;
    if (progress.cancelled()) return false;
    refuseOption(
        "--to", kRos,
        fmt::format("has no subscriber of {} after {} s; topics: {}", what, arguments.wait, player.words()),
        "Start the receiver first, for example: capstan-cli track --live resources/live/ros.yaml");
  };
  notice(fmt::format("waiting for a subscriber of the {}: {}",
                     images && wait_for_images ? "motors and images" : "motors", player.words()));
  if (!wait(Topics::kMotors, "the motors")) return false;
  if (!images) return true;
  if (wait_for_images) return wait(Topics::kImages, "both images");
  if (!player.waitForSubscribers(Topics::kImages, kMoment, &progress) && !progress.cancelled())
    notice("nobody has subscribed to both images; --wait-for-images would wait for that");
  return !progress.cancelled();
}

/// Publishes rows and images on ROS topics, each from a source of its own.
Played playRos(const PlayArguments& arguments, RecordingFormat format, const RowPlay& rows,
               base::Progress& progress) {
  const auto open = [&](Notices notices) {
    return openSource(arguments.file, format, arguments.robot, readAsOf(arguments.read_as), notices);
  };
  const auto motors = open(Notices::kSaid), cameras = open(Notices::kQuiet);
  live::RosPlayer player(motors->info());
  const bool images = motors->info().rig.has_value();
  if (!waitForSubscribers(player, images, arguments, progress)) return {};
  const live::PlayClock clock{.begin = motors->info().begin, .speed = arguments.speed};
  std::future<live::ImagePlayReport> shown;
  if (images)
    shown = std::async(std::launch::async, [&] {
      return player.playImages(
          *cameras, clock,
          optionsOf(arguments.video_faults, arguments.seed, "--video-fault", live::parseImageFault),
          &progress);
    });
  Played played{player.playRows(*motors, clock, rows.options, &progress), {}, clock.started};
  if (shown.valid()) played.images = shown.get();
  return played;
}

/// `pairs`: of the whole recording.
std::string wordsOf(const live::ImagePlayReport& images, std::uint64_t pairs) {
  std::string text = fmt::format("{} of {} pairs of images in time", images.sent - images.late, pairs);
  if (images.late + images.skipped > 0)
    text += fmt::format(", {} late, {} skipped: this computer is too slow", images.late, images.skipped);
  if (pairs > images.pairs()) text += fmt::format(", {} not reached", pairs - images.pairs());
  return text + fmt::format("; {} withheld by faults\n", images.withheld);
}

/// Number of pairs of images in the recording; of other recordings than sessions, of those played.
std::uint64_t pairsOf(const std::string& file, const live::ImagePlayReport& played) {
  if (detectFormat(file) != RecordingFormat::kSession) return played.pairs();
  return static_cast<std::uint64_t>(recording::readSessionSummary(file).frames);
}

std::string wordsOf(const live::PlayReport& report, std::size_t rows, const std::string& to) {
  std::string text = fmt::format(
      "{} of {} rows sent to {} in {:.2f} s; {} withheld by faults; {} connection{}", report.sent, rows, to,
      report.seconds, report.withheld, report.connections, report.connections == 1 ? "" : "s");
  if (report.lost > 0) text += fmt::format("; {} not sent while nobody listened", report.lost);
  return text + "\n";
}

/// A receiver that has taken rows and ends the connection without a complaint has finished.
bool isFailed(const live::PlayReport& report) {
  return report.refused && (report.sent == 0 || !report.answer.empty());
}

void say(const PlayArguments& arguments, const Output& output, std::size_t rows, const Played& played) {
  nlohmann::json json;
  if (const auto& report = played.rows) {
    output.text(wordsOf(*report, rows, arguments.to));
    json = {{"rows", rows},
            {"sent", report->sent},
            {"withheld", report->withheld},
            {"lost", report->lost},
            {"connections", report->connections},
            {"answer", report->answer.empty() ? nlohmann::json() : nlohmann::json(report->answer)}};
    if (!report->answer.empty()) notice("the receiver answered: " + report->answer);
    if (report->refused) notice("the receiver has ended the connection and does not listen any more");
  }
  if (const auto& report = played.images) {
    const std::uint64_t pairs = pairsOf(arguments.file, *report);
    output.text(wordsOf(*report, pairs));
    json["images"] = {{"pairs", pairs},
                      {"sent", report->sent},
                      {"withheld", report->withheld},
                      {"late", report->late},
                      {"skipped", report->skipped}};
  }
  json["started"] = played.started;
  output.json(json);
}

ExitCode play(const PlayArguments& arguments) {
  const std::optional<RowPlay> rows = rowPlayOf(arguments);
  const std::optional<ImagePlay> images = imagePlayOf(arguments);
  if (arguments.wait_for_images && arguments.to != kRos)
    refuseOption("--wait-for-images", "", "needs --to ros", "Leave it out");
  if (!rows && !images)
    refuseOption("--to", "", "is missing, and so is --video", "Give one of them, or both");
  const RecordingFormat format = detectFormat(arguments.file);
  if (images) checkImages(arguments.file, format);
  checkOutputs({{"--json", arguments.json}}, {arguments.file, arguments.robot});
  const Output output(arguments.json);
  base::Progress progress;
  Played played;
  std::size_t count = 0;
  if (const ProgressLine line(progress); arguments.to == kRos) {
    played = playRos(arguments, format, *rows, progress);
    if (played.rows) count = played.rows->sent + played.rows->lost + played.rows->withheld;
  } else {
    const recording::MeasuredTable table = rowsOf(arguments, format);
    count = table.rows();
    played = playBoth(arguments, rows, images, table, progress);
  }
  say(arguments, output, count, played);
  return (played.rows && isFailed(*played.rows)) || progress.cancelled() ? kFailed : kOk;
}

}  // namespace

void addPlay(CLI::App& app, ExitCode& exit) {
  auto arguments = std::make_shared<PlayArguments>();
  CLI::App* command =
      app.add_subcommand("play", "Send a recording in real time, as a robot would, with faults on request");
  command->add_option("FILE", arguments->file, recording::recordingKinds())->required();
  CLI::Option* to = command->add_option("--to", arguments->to,
                                        "receiver of the rows, as in tcp://127.0.0.1:5555;\n"
                                        "ros: topics of a ROS 1 system, with the images");
  command->add_option("--video", arguments->video,
                      "serve the images of a session (Motion JPEG), as in http://127.0.0.1:8081; they go on\n"
                      "while nobody takes the rows, which are tried again every 0.5 s");
  command->add_option("--wait", arguments->wait, "longest time to wait for the receiver of --to [s]")
      ->capture_default_str()
      ->needs(to)
      ->check(CLI::Range(0.0, 86400.0));
  command->add_flag(
      "--wait-for-images", arguments->wait_for_images,
      "with --to ros: begin when somebody subscribes to both images, too, not to the motors alone");
  command
      ->add_option("--speed", arguments->speed,
                   "recording time per wall time; 0: as fast as the receiver takes")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1000.0));
  command
      ->add_option(
          "--fault", arguments->faults,
          "drop:SHARE, repeat:SHARE, jitter:SECONDS (exponential delays of this mean),\n"
          "silence:SECONDS@TIME, freeze:SECONDS@TIME, step:SECONDS@TIME (of the clock) or garbage@TIME;\n"
          "repeatable")
      ->allow_extra_args(false);
  command
      ->add_option(
          "--video-fault", arguments->video_faults,
          "drop:SHARE, jitter:SECONDS, silence:SECONDS@TIME, freeze:SECONDS@TIME or swap:SECONDS@TIME\n"
          "(left and right images are exchanged); repeatable")
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "random seed of the faults")->capture_default_str();
  addReadAs(*command, arguments->read_as);
  command->add_option("--robot", arguments->robot, "robot file, for recordings that contain none");
  command->add_option("--json", arguments->json, "result as JSON: a file, or - for standard output");
  command->footer(
      "Examples:\n"
      "  capstan --live tcp://127.0.0.1:5555                       (in one terminal)\n"
      "  capstan-cli play trial.capstan --to tcp://127.0.0.1:5555  (in another one)\n"
      "  capstan-cli play trial.csv --to tcp://127.0.0.1:5555 --fault jitter:0.02 --fault silence:2@10\n"
      "  capstan-cli play trial.capstan --to tcp://127.0.0.1:5555 --video http://127.0.0.1:8081\n"
      "  capstan-cli play trial.capstan --to ros");
  command->callback([arguments, &exit] { exit = play(*arguments); });
}

}  // namespace capstan::cli
