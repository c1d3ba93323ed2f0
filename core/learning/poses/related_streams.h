#pragma once

#include "core/learning/poses/states.h"

namespace capstan::learning {

/// Checks that one rigid offset relates the observed and the commanded stream of each table; otherwise
/// nothing can be learned. In each table the median distance from the commanded position after the offset
/// must be small compared with the length of the motions. The median rotation after the offset must be
/// similar to that of all tables. `states` are those of `motions`. Throws base::InputError naming the table
/// that fails, and the axes that are in another unit if they can be determined.
void checkRelated(const std::vector<PoseMotion>& motions, const std::vector<State>& states,
                  const Eigen::Isometry3d& offset, StreamKind towards);

}  // namespace capstan::learning
