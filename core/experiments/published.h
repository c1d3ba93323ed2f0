#pragma once

#include <array>
#include <filesystem>

#include "core/base/field.h"

/// Numbers of the UKF paper from resources/experiments/published.yaml, in the units printed there: deg, deg,
/// cm, seconds, mm.
namespace capstan::experiments {

struct PublishedRadius {
  double nominal_mm = 0.0, identified_mm = 0.0;
  double converged_after = 0.0;  ///< time to converge [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.nominal_mm, {"nominal_mm", "mm", "pulley radius of joint 1 by design", base::kPositive});
    field(self.identified_mm, {"identified_mm", "mm", "identified pulley radius", base::kPositive});
    field(self.converged_after, {"converged_after", "s", "time to converge", base::kPositive});
  }
};

/// One joint of table I.
struct PublishedJoint {
  std::array<double, 6> ukf{}, kinematic{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.ukf, {"ukf", "deg or cm", "RMS error by trial", base::kPositive});
    field(self.kinematic, {"kinematic", "deg or cm", "RMS error by trial", base::kPositive});
  }
};

struct PublishedTrials {
  std::array<double, 6> duration{};
  PublishedJoint joint_1, joint_2, joint_3;

  const PublishedJoint& joint(int index) const {
    return index == 0 ? joint_1 : index == 1 ? joint_2 : joint_3;
  }

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.duration, {"duration", "s", "duration of each trial", base::kPositive});
    field(self.joint_1, {"joint_1", "deg", "table I, joint 1"});
    field(self.joint_2, {"joint_2", "deg", "table I, joint 2"});
    field(self.joint_3, {"joint_3", "cm", "table I, joint 3"});
  }
};

struct PublishedMeans {
  std::array<double, 3> ukf{}, kinematic{}, improvement{}, p_value{};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.ukf, {"ukf", "deg, deg, cm", "mean over the trials", base::kPositive});
    field(self.kinematic, {"kinematic", "deg, deg, cm", "mean over the trials", base::kPositive});
    field(self.improvement, {"improvement", "%", "improvement of the means", {-1e3, 100.0}});
    field(self.p_value, {"p_value", "", "P of a pooled two-sided t-test", {0.0, 1.0}});
  }
};

struct Published {
  PublishedRadius radius;
  PublishedTrials table_1;
  PublishedMeans table_2;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.radius, {"radius", "", "experiment A"});
    field(self.table_1, {"table_1", "", "experiment C by trial"});
    field(self.table_2, {"table_2", "", "experiment C on average"});
  }
};

/// Factor from the published units of joint 0…2 (deg, deg, cm) to deg, deg, mm.
inline double publishedScale(int joint) { return joint == 2 ? 10.0 : 1.0; }

/// Reads the numbers from `file`; empty: from the resources. Throws base::InputError.
Published readPublished(const std::filesystem::path& file = {});

}  // namespace capstan::experiments
