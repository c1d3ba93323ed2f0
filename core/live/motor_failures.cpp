#include "core/live/motor_failures.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "core/base/error.h"

namespace capstan::live {
namespace {

using tracking::MotorFault;

[[noreturn]] void refuse(const std::string& text, const std::string& option) {
  throw base::InputError({{},
                          0,
                          option,
                          text,
                          "is not a motor with a time and a fault",
                          "Give motor@seconds, optionally followed by :frozen or :lost: 2@60, all@30:lost"});
}

std::optional<double> finiteNumberOf(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<MotorFault> faultOf(std::string_view name) {
  if (name == "frozen") return MotorFault::kFrozen;
  if (name == "lost") return MotorFault::kLost;
  return std::nullopt;
}

}  // namespace

std::vector<MotorFailure> parseMotorFailure(const std::string& text, const std::string& option) {
  const std::string_view all = text;
  const std::size_t at = all.find('@'), colon = all.find(':');
  if (at == std::string_view::npos || (colon != std::string_view::npos && colon < at)) refuse(text, option);
  const std::string_view motor = all.substr(0, at);
  const auto time =
      finiteNumberOf(all.substr(at + 1, colon == std::string_view::npos ? colon : colon - at - 1));
  const auto fault = colon == std::string_view::npos ? MotorFault::kFrozen : faultOf(all.substr(colon + 1));
  if (!time || *time < 0.0 || !fault) refuse(text, option);
  std::vector<MotorFailure> failures;
  for (int i = 0; i < 3; ++i)
    if (motor == "all" || motor == std::to_string(i + 1)) failures.push_back({i, *time, *fault});
  if (failures.empty()) refuse(text, option);
  return failures;
}

void MotorFailures::apply(tracking::MotorSample& sample) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d position = sample.position;
  for (const MotorFailure& failure : failures_) {
    if (!(sample.t >= failure.time)) continue;
    const bool frozen = failure.fault == MotorFault::kFrozen;
    sample.position(failure.motor) = frozen ? held_(failure.motor) : kNan;
    sample.velocity(failure.motor) = frozen ? 0.0 : kNan;
  }
  for (int i = 0; i < 3; ++i)
    if (std::isfinite(sample.position(i)) && sample.position(i) == position(i)) held_(i) = position(i);
}

bool FailingMotors::next(tracking::Sample& out) {
  if (!source_.next(out)) return false;
  if (auto* motor = std::get_if<tracking::MotorSample>(&out)) failures_.apply(*motor);
  return true;
}

}  // namespace capstan::live
