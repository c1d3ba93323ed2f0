#pragma once

#include "core/live/runner.h"

namespace capstan::live {

/// Buffer sizes of a recorder for a source: size of its images (none without a rig), and numbers of rows and
/// images at the expected or measured rates, whichever is higher, at the requested speed. The buffers hold at
/// least 2 s, for up to 60 pairs of images per second: 120 pairs are the upper limit of the memory. Where the
/// sender waits, the recorder does too, and drops nothing.
recording::RecorderOptions recorderOptionsFor(const tracking::SourceInfo& info, const RunStatus& status);

}  // namespace capstan::live
