#include "widgets/figures/joint_errors.h"

namespace capstan::widgets {

void appendErrors(JointHistory& errors, tracking::Snapshot snapshot) {
  if (!errors.empty() && snapshot.t < errors.end() - JointHistory::kSetBack) errors.clear();
  const bool paired = snapshot.reference_paired || !snapshot.q_link_true.allFinite();
  snapshot.q_link_kin -= snapshot.q_link_true;
  snapshot.q_link_ukf -= snapshot.q_link_true;
  snapshot.q_link_cam -= snapshot.q_link_true_cam;
  snapshot.q_link_true -= snapshot.q_link_true;  // NaN where unknown
  if (paired) errors.appendRow(snapshot);
  errors.appendCamera(snapshot);
}

}  // namespace capstan::widgets
