#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/identification/drive_model.h"
#include "core/robot/description.h"

namespace capstan::identification {

/// Quantities of a drive that can be identified from a measured load.
enum class DriveQuantity {
  kLinkRadius,
  kStiffness,
  kExponent,
  kDamping,
  kCoulomb,
  kViscous,
  kMotorCoulomb,
  kMotorViscous
};

inline constexpr int kDriveQuantities = 8;

/// One parameter w of a drive. It is identified as ln(w / nominal), so that it stays positive.
struct DriveParameter {
  DriveQuantity quantity = DriveQuantity::kLinkRadius;
  bool sliding = false;      ///< true for a prismatic joint, which has other units
  double nominal = 1.0;      ///< nominal value, SI
  double prior_sigma = 1.0;  ///< prior standard deviation of the logarithm
  double bound = 5.0;        ///< largest absolute value of the logarithm
  bool asked = false;        ///< true: identified; false: stays nominal

  std::string name() const;   ///< r_l, k_c, a, b_e, f_c, f_v, tau_c, tau_v
  std::string words() const;  ///< "the pulley radius"
  double scale() const;       ///< factor from SI to unit()
  std::string unit() const;   ///< unit for people: mm, N/m, …
};

/// ln(w / nominal) by DriveQuantity; 0 where a parameter is not identified.
using DriveLogs = Eigen::Matrix<double, kDriveQuantities, 1>;

/// Parameters of a one-joint robot. The cable is described by its stiffness at rest, k_c = 2 k_e a, and its
/// exponent a. These two can be distinguished, unlike k_e and a; a linear cable is described by k_c alone.
class DriveParameters {
 public:
  /// `names`: separated by commas, with or without the joint number 1 (r_l1), or "all"; k_e is another name
  /// of k_c. Throws base::InputError for an unknown or repeated name, a robot that does not have exactly one
  /// joint, or a requested parameter with nominal value zero.
  DriveParameters(const robot::Description& nominal, const std::string& names);

  const DriveParameter& operator[](int i) const { return parameters_[static_cast<std::size_t>(i)]; }
  const std::array<DriveParameter, kDriveQuantities>& all() const { return parameters_; }
  const robot::Description& nominal() const { return nominal_; }

  /// Constants of the drive model; `logs` points to kDriveQuantities values.
  template <class T>
  DriveLaw<T> law(const T* logs) const {
    using std::exp;
    const auto at = [&](DriveQuantity which) {
      const auto i = static_cast<std::size_t>(which);
      return T(parameters_[i].nominal * exp(logs[i]));
    };
    const robot::Drive& drive = nominal_.drives.front();
    using Q = DriveQuantity;
    return {drive.motor_capstan_radius / drive.gear_ratio,
            nominal_.coupling.front().front(),
            drive.motor_friction.smoothing,
            nominal_.joints.front().homing,
            at(Q::kLinkRadius),
            at(Q::kStiffness),
            at(Q::kExponent),
            at(Q::kDamping),
            at(Q::kCoulomb),
            at(Q::kViscous),
            at(Q::kMotorCoulomb),
            at(Q::kMotorViscous)};
  }
  /// Nominal robot with the parameters of `logs` and its hard stop moved by `offset` [rad or m].
  robot::Description robot(const DriveLogs& logs, double offset) const;

 private:
  robot::Description nominal_;
  std::array<DriveParameter, kDriveQuantities> parameters_;
};

inline constexpr const char* kAllDriveParameters = "r_l,k_c,a,b_e,f_c,f_v,tau_c,tau_v";

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::DriveQuantity> {
  using Q = capstan::identification::DriveQuantity;
  static constexpr std::array value = {
      std::pair{Q::kLinkRadius, "r_l"},     std::pair{Q::kStiffness, "k_c"},
      std::pair{Q::kExponent, "a"},         std::pair{Q::kDamping, "b_e"},
      std::pair{Q::kCoulomb, "f_c"},        std::pair{Q::kViscous, "f_v"},
      std::pair{Q::kMotorCoulomb, "tau_c"}, std::pair{Q::kMotorViscous, "tau_v"}};
};
