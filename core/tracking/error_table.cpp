#include "core/tracking/error_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace capstan::tracking {

void ErrorTable::add(const Snapshot& snapshot) {
  if (snapshot.reference_paired) {
    kinematic_.add(snapshot.q_link_kin - snapshot.q_link_true);
    ukf_.add(snapshot.q_link_ukf - snapshot.q_link_true);
    if (snapshot.gate == Gate::kOpen) ukf_seen_.add(snapshot.q_link_ukf - snapshot.q_link_true);
  }
  if (snapshot.camera_updated && snapshot.gate == Gate::kOpen)
    camera_.add(snapshot.q_link_cam - snapshot.q_link_true_cam);
}

std::string ErrorTable::text(std::string_view head) const {
  std::string text = fmt::format("{:<9}{:>12}{:>12}{:>12}\n", head, "kinematic", "camera", "UKF");
  const std::array<const JointRms*, 3> columns = {&kinematic_, &camera_, &ukf_};
  for (int joint = 0; joint < 3; ++joint) {
    text += fmt::format("q{} [{}] ", joint + 1, kJointUnits[static_cast<std::size_t>(joint)])
                .append(joint == 2 ? " " : "");
    for (const JointRms* column : columns) {
      const double shown = forPeople(column->value()(joint), joint);
      text += std::isnan(shown) ? fmt::format("{:>12}", "-") : fmt::format("{:>12.4f}", shown);
    }
    text += '\n';
  }
  return text;
}

}  // namespace capstan::tracking
