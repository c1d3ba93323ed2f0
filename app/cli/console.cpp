#include "app/cli/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>

#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::cli {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void onInterrupt(int) { interrupted = 1; }

}  // namespace

ProgressLine::ProgressLine(base::Progress& progress)
    : interrupt_(std::signal(SIGINT, onInterrupt)),
      terminate_(std::signal(SIGTERM, onInterrupt)),
      thread_([&progress](const std::stop_token& stop) {
        const bool terminal = isatty(STDERR_FILENO) != 0;
        bool shown = false;
        while (!stop.stop_requested()) {
          std::this_thread::sleep_for(std::chrono::milliseconds(100));
          if (interrupted) progress.cancel();
          const double fraction = progress.fraction();
          if (!terminal || fraction <= 0.0) continue;
          fmt::print(stderr, "\r\033[K{:3.0f} % {}", 100.0 * fraction, progress.doing());
          std::fflush(stderr);
          shown = true;
        }
        if (shown) fmt::print(stderr, "\r\033[K");
      }) {}

ProgressLine::~ProgressLine() {
  thread_.request_stop();
  thread_.join();
  std::signal(SIGINT, interrupt_);
  std::signal(SIGTERM, terminate_);
}

void Output::text(const std::string& text) const {
  if (json_target_ != "-") fmt::print("{}", text);
}

void Output::json(const nlohmann::json& document) const {
  if (json_target_.empty()) return;
  nlohmann::json versioned = document;
  if (versioned.is_object()) versioned["schema"] = kJsonSchema;
  const std::string text = versioned.dump(2) + "\n";
  if (json_target_ == "-")
    fmt::print("{}", text);
  else
    base::writeTextFile(json_target_, text);
}

void refuseFile(const std::string& file, const std::string& reason, const std::string& remedy) {
  throw base::InputError({file, 0, {}, {}, reason, remedy});
}

void refuseOption(const std::string& name, const std::string& value, const std::string& reason,
                  const std::string& remedy) {
  throw base::InputError({{}, 0, name, value, reason, remedy});
}

void notice(const std::string& text) { fmt::print(stderr, "capstan-cli: {}\n", text); }

nlohmann::json toJson(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

nlohmann::json toJson(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond rotation(pose.rotation());
  return {{"position", toJson(Eigen::Vector3d(pose.translation()))},
          {"quaternion", {rotation.x(), rotation.y(), rotation.z(), rotation.w()}}};
}

std::string isoNow() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &local);
  return text;
}

int secondsOfIso(const std::string& text) {
  std::tm time{};
  const char* end = ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &time);
  return end == nullptr ? 0 : static_cast<int>(::timegm(&time));
}

}  // namespace capstan::cli
