#include "core/robot/remote_centre.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"

namespace capstan::robot {
namespace {

constexpr double kSquare = 1e-12;  ///< largest |cos(alpha)| that counts as a right angle

[[noreturn]] void refuse(const Description& description, std::string key, std::string value,
                         std::string reason) {
  throw base::InputError({description.name, 0, std::move(key), std::move(value), std::move(reason),
                          "Use a robot file like raven2_left.yaml, or the functions for general chains"});
}

void requireZero(const Description& description, const std::string& key, double value) {
  if (value != 0.0)
    refuse(description, key, fmt::format("{}", value), "is not 0, as a remote-centre arm needs");
}

}  // namespace

void requireRemoteCentreArm(const Description& description) {
  if (description.size() != 3)
    refuse(description, "joints", fmt::format("{}", description.size()), "is not three joints");
  constexpr std::array kTypes = {JointType::kRevolute, JointType::kRevolute, JointType::kPrismatic};
  for (std::size_t i = 0; i < 3; ++i) {
    const Joint& joint = description.joints[i];
    const std::string key = fmt::format("joints[{}]", i);
    if (joint.type != kTypes[i])
      refuse(description, key + ".type", std::string(base::nameOf(joint.type)),
             fmt::format("is not {}, as a remote-centre arm needs", base::nameOf(kTypes[i])));
    requireZero(description, key + ".dh.a", joint.dh.a);
    if (i < 2) requireZero(description, key + ".dh.d", joint.dh.d);
  }
}

void requireToolWrist(const Description& description) {
  if (description.wrist.empty()) return;
  if (description.wrist.size() != 3)
    refuse(description, "wrist", fmt::format("{}", description.wrist.size()),
           "is not three rows (roll, wrist, jaw)");
  requireZero(description, "wrist[0].alpha", description.wrist[0].alpha);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string key = fmt::format("wrist[{}]", i);
    if (i < 2) requireZero(description, key + ".a", description.wrist[i].a);
    if (i > 0) requireZero(description, key + ".d", description.wrist[i].d);
    if (i > 0 && std::abs(std::cos(description.wrist[i].alpha)) > kSquare)
      refuse(description, key + ".alpha", fmt::format("{}", description.wrist[i].alpha),
             "is not a right angle");
  }
}

}  // namespace capstan::robot
