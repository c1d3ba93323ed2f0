#pragma once

#include "core/learning/states.h"

namespace capstan::learning {

/// Half of the states must be nearer to what was told, the offset taken off, than the motions are long: else
/// no offset relates the two streams, and nothing can be learned of what it leaves. base::InputError: they
/// are not, with the axes that are in another unit, where these can be told.
void checkRelated(const std::vector<State>& states, const Eigen::Isometry3d& offset, StreamKind towards);

}  // namespace capstan::learning
