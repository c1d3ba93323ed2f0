#pragma once

#include "core/learning/poses/states.h"

namespace capstan::learning {

/// Of each table half of the states must be nearer to what was told, the offset taken off, than all motions
/// are long: else no offset relates the two streams, and nothing can be learned of what it leaves. Beside
/// other tables half of them must be turned about as the others' are, too. States are of `motions`.
/// base::InputError naming the table: they are not; with the axes that are in another unit, where these can
/// be told.
void checkRelated(const std::vector<PoseMotion>& motions, const std::vector<State>& states,
                  const Eigen::Isometry3d& offset, StreamKind towards);

}  // namespace capstan::learning
