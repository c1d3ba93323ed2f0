#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"

namespace capstan::diagnosis {

/// What a recording gave, each sensor at times of its own; NaN where it gave nothing.
struct RecordedTracks {
  std::string file, title;
  std::vector<double> t;  ///< of the motor side, rising [s]
  Columns q_m, dq_m, tau_m, tau_ext;
  std::vector<double> t_q;  ///< of the joint encoders, rising [s]
  Columns q;
  std::vector<double> t_tip;  ///< of the cameras, rising [s]
  std::vector<Eigen::Vector3d> tip;
  bool own_kinematics = false;  ///< joint positions were excluded: the robot computed them from its motors
  std::vector<std::string> notices;
};

/// Puts the tracks on an even grid. Errors as evidenceOf() (read_evidence.h).
Evidence assembleEvidence(const RecordedTracks& tracks, const robot::Description& robot,
                          const EvidenceOptions& options);

/// Rows of a channel that stands at its end: runs of five rows or more at the very largest or smallest value
/// of all, entered or left with a jerk (a second difference beyond six times the noise and three times the
/// channel's 99 % quantile). A motion that turns or rests there slows down before. `column`, NaN where
/// nothing was read, on the rows of `segments`.
std::vector<std::uint8_t> standsAtEnd(const std::vector<double>& column, const std::vector<Segment>& segments,
                                      double noise);

/// Noise of the tips from their distance to where joints (encoders, or else the motors' transmission
/// kinematics) put them, which takes the motion out; observations farther than eight times the spread (and a
/// millimetre) from both the median of seven about them and the cubic through their neighbours no longer
/// count.
void judgeObservations(Evidence& evidence, const robot::Description& robot);

}  // namespace capstan::diagnosis
