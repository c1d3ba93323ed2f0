#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::identification {

/// Quantities of a joint and its cable that can be identified.
enum class Quantity { kLinkRadius, kStiffness, kDamping, kFriction };

inline constexpr int kQuantities = 4;
inline constexpr int kMostParameters = 3 * kQuantities;  ///< parameters of three joints

/// The three values of `quantity` in a struct with the field names of CableArmConstants.
template <class Cables>
auto& fieldOf(Cables& cables, Quantity quantity) {
  switch (quantity) {
    case Quantity::kLinkRadius:
      return cables.link_radius;
    case Quantity::kStiffness:
      return cables.stiffness;
    case Quantity::kDamping:
      return cables.damping;
    default:
      return cables.coulomb;
  }
}

/// One parameter w. It is identified as ln(w / nominal), so that it stays positive.
struct Parameter {
  Quantity quantity = Quantity::kLinkRadius;
  int joint = 0;             ///< joint index 0…2
  double nominal = 1.0;      ///< nominal value, SI
  double prior_sigma = 0.1;  ///< prior standard deviation of ln(w / nominal)
  double bound = 0.25;       ///< largest |ln(w / nominal)|
  double goal = 0.002;       ///< σ of ln w below which w counts as known

  std::string name() const;   ///< r_l1, k_e2, b_e3, f_c1
  std::string words() const;  ///< "joint 1's pulley radius"
  double scale() const;       ///< factor from SI to unit()
  std::string unit() const;   ///< mm (m/m for an insertion), N, N·s/m, N·m (N for an insertion)
};

/// Priors, bounds and goals of radius, stiffness, damping and friction.
struct ParameterOptions {
  Eigen::Vector4d prior_sigma{0.05, 1.0, 1.0, 0.3};  ///< prior σ of the logarithms
  Eigen::Vector4d bound{0.25, 5.0, 3.0, 2.0};        ///< largest absolute values of the logarithms
  Eigen::Vector4d goal{0.002, 0.05, 0.15, 0.1};      ///< σ of the logarithms that is good enough

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.prior_sigma,
          {"prior_sigma", "", "prior sigma of ln r_l, ln k_e, ln b_e, ln F_cl", {1e-6, 10.0}, false});
    field(self.bound,
          {"bound", "", "largest change of ln r_l, ln k_e, ln b_e, ln F_cl", {1e-6, 10.0}, false});
    field(self.goal,
          {"goal", "", "sigma of ln r_l, ln k_e, ln b_e, ln F_cl that is good enough", {1e-6, 10.0}, false});
  }
};

/// Parameters of one identification, and their conversion to a robot. Logs are size() values of ln(w /
/// nominal) in this set's order.
class ParameterSet {
 public:
  using Logs = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostParameters, 1>;

  /// `names`, separated by commas: r_l1…3, k_e1…3, b_e1…3, f_c1…3 (Coulomb friction F_cl), or r_l, k_e, b_e,
  /// f_c for all three joints, or "all". Effects of the robot file are folded into the parameters of
  /// nominal() (robot::foldEffects()). Throws base::InputError for an unknown or repeated name, a robot that
  /// is not a three-joint remote-centre arm, or an effect that cannot be folded, except camera effects and
  /// sensor_sign.
  ParameterSet(const robot::Description& nominal, const std::string& names,
               const ParameterOptions& options = {});

  int size() const { return static_cast<int>(parameters_.size()); }
  const Parameter& operator[](int i) const { return parameters_[static_cast<std::size_t>(i)]; }
  const std::vector<Parameter>& all() const { return parameters_; }
  const robot::Description& nominal() const { return nominal_; }

  double value(int i, double log) const;  ///< value of parameter i, SI
  /// Nominal robot with the parameters of `logs`.
  robot::Description robot(const Logs& logs) const;
  tracking::CableArmConstants constants(const Logs& logs) const;
  /// tracking::cableArmRate() of robot(logs) [1/s].
  double rate(const Logs& logs) const;
  /// Slowest time constant of a nominal joint [s]: (damping and creeping friction) / stiffness.
  double slowestTime() const;

 private:
  robot::Description nominal_;
  tracking::CableArmConstants constants_;
  std::vector<Parameter> parameters_;
};

/// Default parameters: those of experiments A and B of the UKF paper and joint friction, without which a soft
/// cable cannot be distinguished. The pulley radii of all joints are included: one radius alone would absorb
/// the errors of the others through the camera pose.
inline constexpr const char* kDefaultParameters = "r_l,k_e,b_e,f_c";

/// One difference between two robot files.
struct RobotChange {
  std::string key;  ///< key in the file: drives[0].link_radius
  double nominal = 0.0, identified = 0.0;
  double percent = 0.0;  ///< change relative to nominal [%]; NaN where nominal is zero

  /// The parameter that changes, with its nominal value; nothing where it is none.
  std::optional<Parameter> parameter() const;
  /// Name of the parameter, Parameter::name(): r_l1 for drives[0].link_radius. Empty: it is none.
  std::string name() const;
};

/// Returns every number that differs between two robots. Throws base::InputError unless they have the same
/// number of joints.
std::vector<RobotChange> differences(const robot::Description& nominal, const robot::Description& identified);

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::Quantity> {
  using Q = capstan::identification::Quantity;
  static constexpr std::array value = {std::pair{Q::kLinkRadius, "r_l"}, std::pair{Q::kStiffness, "k_e"},
                                       std::pair{Q::kDamping, "b_e"}, std::pair{Q::kFriction, "f_c"}};
};
