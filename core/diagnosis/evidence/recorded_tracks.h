#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"

namespace capstan::diagnosis {

/// Readings of a recording, each sensor at its own times; NaN marks a missing reading.
struct RecordedTracks {
  std::string file, title;
  std::vector<double> t;  ///< times of the motor side, rising [s]
  Columns q_m, dq_m, tau_m, tau_ext;
  std::vector<double> t_q;  ///< times of the joint encoders, rising [s]
  Columns q;
  std::vector<double> t_tip;  ///< times of the cameras, rising [s]
  std::vector<Eigen::Vector3d> tip;
  bool own_kinematics = false;  ///< true if joint positions were excluded because the robot computed them
  std::vector<std::string> notices;
};

/// Evidence of the tracks, on a grid with a constant time step. Throws as evidenceOf() (read_evidence.h).
Evidence assembleEvidence(const RecordedTracks& tracks, const robot::Description& robot,
                          const EvidenceOptions& options);

/// Rows at which a sensor stands at the end of its range, one 0 or 1 per row of `column`. Such rows are runs
/// of five or more readings at exactly the channel's largest or smallest value that begin or end with a jerk:
/// a second difference beyond six times the noise and three times the channel's 99 % quantile. A joint that
/// really reverses or rests there slows down first, without a jerk. NaN in `column` marks a missing reading.
std::vector<std::uint8_t> standsAtEnd(const std::vector<double>& column, const std::vector<Segment>& segments,
                                      double noise);

/// Sets the noise of the tips, and marks outliers as not counting. Both use the distance of each observation
/// from the forward kinematics of the joint encoders (or else of the motors, with rigid cables), which
/// removes the motion. Outliers are farther than eight times the spread, and farther than a millimetre, both
/// from the median of the seven observations around them and from the cubic through their neighbours.
void judgeObservations(Evidence& evidence, const robot::Description& robot);

}  // namespace capstan::diagnosis
