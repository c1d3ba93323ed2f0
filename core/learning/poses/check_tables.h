#pragma once

#include <span>

#include "core/learning/poses/pose_motion.h"

namespace capstan::learning {

/// Checks motions table by table (RawMotion::table; motions of one table are contiguous), because an unusable
/// table among others would otherwise be excluded silently. Throws base::InputError naming a table without
/// observed or commanded poses, with stamps that are not in seconds, or with positions that are not in
/// metres.
void checkTables(std::span<const RawMotion> motions, StreamKind towards);

}  // namespace capstan::learning
