#pragma once

#include "core/live/runner.h"

namespace capstan::widgets {

/// What a recorder must hold for a source: its pictures' size (none without a rig), and rows and pictures at
/// the rates expected or reached by now, whichever is higher, at the requested speed. 2 s of them at least,
/// for up to 60 pairs of pictures a second: 120 pairs are the most memory that is taken.
recording::RecorderOptions recorderOptionsFor(const tracking::SourceInfo& info,
                                              const live::RunStatus& status);

}  // namespace capstan::widgets
