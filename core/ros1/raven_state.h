#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/ros1/message_data.h"

namespace capstan::ros1 {

/// Parts of the message `raven_state` that the RAVEN-II's software publishes: two arms of eight entries.
/// Positions are in degrees of the motor shaft and of the joint (insertion: metres times 180/π), torque
/// commands as published.
struct RavenState {
  std::int64_t stamp = 0;  ///< [ns]; 0: the software had no valid state
  std::array<float, 16> tau{}, mpos{}, jpos{}, mvel{};
};

/// True for the message's type: its package was called raven_2, raven2 or raven_control.
bool isRavenState(const std::string& type);

/// Positions of the fields in the serialised message. Versions of the software differ in their fields, so
/// they are found by their names in the definition that every publisher and every bag states.
class RavenStateLayout {
 public:
  /// Throws base::InputError for a definition without one of the fields hdr, tau, mpos, jpos, mvel, and for
  /// one with a field of variable length before them, other than the header.
  explicit RavenStateLayout(const std::string& definition);
  /// Throws base::InputError for bytes that end too early.
  RavenState read(const Bytes& bytes) const;

  /// The definition that the published software of the robot has (uw-biorobotics/raven2,
  /// msg/raven_state.msg).
  static const char* const kDefinition;

 private:
  std::size_t tau_ = 0, mpos_ = 0, jpos_ = 0, mvel_ = 0;  ///< bytes after the header
};

}  // namespace capstan::ros1
