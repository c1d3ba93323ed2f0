#pragma once

#include "core/learning/poses/states.h"

namespace capstan::learning {

/// Checks that one rigid offset relates the observed and the commanded stream of each table; without it
/// nothing can be learned. In each table half of the states must lie nearer to their commanded position, less
/// the offset, than the length of the motions. Beside other tables, half of them must also be rotated about
/// as the others' are. States are of `motions`. base::InputError naming the table that fails, and its axes in
/// another unit where these can be determined.
void checkRelated(const std::vector<PoseMotion>& motions, const std::vector<State>& states,
                  const Eigen::Isometry3d& offset, StreamKind towards);

}  // namespace capstan::learning
