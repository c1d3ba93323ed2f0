#include "core/robot/raven_software.h"

#include <array>

#include "core/base/check.h"
#include "core/base/units.h"
#include "core/robot/transmission.h"

namespace capstan::robot {
namespace {

/// TR of the robot's software, N r / r_mc [rad/rad, rad/rad, rad/m], and the published radii divided by its
/// own.
constexpr std::array kTransmissionRatio = {12.25 * 63.095e-3 / 5.675e-3, 12.25 * 56.297e-3 / 5.675e-3,
                                           12.25 * 1.0 / 5.675e-3};
constexpr std::array kRounding = {1.0, 56.298 / 56.297, 1.0};

}  // namespace

RavenSoftware::RavenSoftware(const Description& robot) {
  CAPSTAN_CHECK(robot.size() == 3);
  // A q_hs: unit radii make the coupled travel of linkTravel(), which counts from the hard stop.
  Description unit = robot;
  for (Drive& drive : unit.drives) drive.link_radius = 1.0;
  const JointVector coupled = -Transmission(unit).linkTravel(JointVector::Zero(3));
  for (int motor = 0; motor < 3; ++motor)
    at_stop_[motor] = kTransmissionRatio[static_cast<std::size_t>(motor)] * coupled(motor);
}

double RavenSoftware::motorPosition(int motor, double m) const {
  return kRounding[static_cast<std::size_t>(motor)] * (m * base::kRadiansPerDegree - at_stop_[motor]);
}

double RavenSoftware::motorSpeed(int motor, double dm) const {
  return dm * base::kRadiansPerDegree * kRounding[static_cast<std::size_t>(motor)];
}

double RavenSoftware::joint(double value) { return value * base::kRadiansPerDegree; }

}  // namespace capstan::robot
