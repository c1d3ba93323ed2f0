#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_kernel.h"

namespace capstan::identification {

/// What can be identified of a drive.
enum class Quantity { kLinkRadius, kStiffness, kDamping, kFriction };

inline constexpr int kQuantities = 4;
inline constexpr int kMostParameters = 3 * kQuantities;  ///< of three joints

/// A quantity's three values in a struct that names them as CableArmConstants does.
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

/// One parameter w, as ln(w / nominal), so that it stays positive.
struct Parameter {
  Quantity quantity = Quantity::kLinkRadius;
  int joint = 0;             ///< 0…2
  double nominal = 1.0;      ///< SI
  double prior_sigma = 0.1;  ///< of ln(w / nominal), before any measurement
  double bound = 0.25;       ///< |ln(w / nominal)| stays below
  double goal = 0.002;       ///< σ of ln w at which it counts as known

  std::string name() const;   ///< r_l1, k_e2, b_e3, f_c1
  std::string words() const;  ///< "joint 1's pulley radius"
  double scale() const;       ///< from SI to the unit for people
  std::string unit() const;   ///< mm (m/m for an insertion), N, N·s/m, N·m (N for an insertion)
};

/// Width of the priors and goals by quantity.
struct ParameterOptions {
  Eigen::Vector4d prior_sigma{0.05, 1.0, 1.0,
                              0.3};              ///< radius, stiffness, damping, friction; of the logarithm
  Eigen::Vector4d bound{0.25, 5.0, 3.0, 2.0};    ///< of the logarithm
  Eigen::Vector4d goal{0.002, 0.05, 0.15, 0.1};  ///< of the logarithm

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.prior_sigma,
          {"prior_sigma", "", "of ln r_l, ln k_e, ln b_e, ln F_cl about nominal", {1e-6, 10.0}, false});
    field(self.bound,
          {"bound", "", "largest change of ln r_l, ln k_e, ln b_e, ln F_cl", {1e-6, 10.0}, false});
    field(self.goal,
          {"goal", "", "sigma of ln r_l, ln k_e, ln b_e, ln F_cl that is good enough", {1e-6, 10.0}, false});
  }
};

/// The parameters that one identification asks for, and how they enter a robot. Logs: size() values of
/// ln(w / nominal), in this set's order.
class ParameterSet {
 public:
  using Logs = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostParameters, 1>;

  /// `names`, separated by commas: r_l1…3, k_e1…3, b_e1…3, f_c1…3 (Coulomb friction F_cl), or r_l, k_e, b_e,
  /// f_c for all three joints, or "all". Throws base::InputError for anything else, a name that comes twice,
  /// or a robot that is no three-joint remote-centre arm. Effects of the robot file that its numbers can hold
  /// are in nominal() (robot::foldEffects()); one that they cannot hold is refused, but for the cameras'.
  ParameterSet(const robot::Description& nominal, const std::string& names,
               const ParameterOptions& options = {});

  int size() const { return static_cast<int>(parameters_.size()); }
  const Parameter& operator[](int i) const { return parameters_[static_cast<std::size_t>(i)]; }
  const std::vector<Parameter>& all() const { return parameters_; }
  const robot::Description& nominal() const { return nominal_; }

  double value(int i, double log) const;  ///< SI
  /// The nominal robot with these parameters: a robot file (robot::formatDescription).
  robot::Description robot(const Logs& logs) const;
  tracking::CableArmConstants constants(const Logs& logs) const;
  /// tracking::cableArmRate() of robot(logs) [1/s].
  double rate(const Logs& logs) const;
  /// Slowest relaxation of a nominal joint: damping and creeping friction by stiffness [s].
  double slowestTime() const;

 private:
  robot::Description nominal_;
  tracking::CableArmConstants constants_;
  std::vector<Parameter> parameters_;
};

/// The parameters requested when nobody says which: those of experiments A and B of the UKF paper, joint
/// friction, without which a soft cable cannot be distinguished, and the pulleys of all joints: one alone
/// would take the others' errors on itself, through the camera's pose.
inline constexpr const char* kDefaultParameters = "r_l,k_e,b_e,f_c";

/// One value of two robot files that differs.
struct RobotChange {
  std::string key;  ///< as in the file: drives[0].link_radius
  double nominal = 0.0, identified = 0.0;
  double percent = 0.0;  ///< of nominal; NaN where that is zero
};

/// Every number that differs between two robots of equal joint count. Throws base::InputError otherwise.
std::vector<RobotChange> differences(const robot::Description& nominal, const robot::Description& identified);

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::Quantity> {
  using Q = capstan::identification::Quantity;
  static constexpr std::array value = {std::pair{Q::kLinkRadius, "r_l"}, std::pair{Q::kStiffness, "k_e"},
                                       std::pair{Q::kDamping, "b_e"}, std::pair{Q::kFriction, "f_c"}};
};
