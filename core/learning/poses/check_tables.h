#pragma once

#include <span>

#include "core/learning/poses/pose_motion.h"

namespace capstan::learning {

/// Looks at motions table by table (RawMotion::table, those of one stand together): beside others a table
/// that cannot be learned from would be excluded without a word. base::InputError naming the table: it has no
/// observed or commanded poses, or its stamps that are not seconds or positions that are not metres.
void checkTables(std::span<const RawMotion> motions, StreamKind towards);

}  // namespace capstan::learning
