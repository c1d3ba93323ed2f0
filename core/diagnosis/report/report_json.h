#pragma once

#include <nlohmann/json.hpp>

#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// Report as JSON. Numbers are in SI, to the last bit; NaN and infinity are null. The verdict of a cancelled
/// report is null. The samples of channels are omitted, and so are the robots, which are files of their own.
///     {"verdict": "found|several|tie|nothing|unexplained", "summary", "explained", "cancelled",
///     "search_complete",
///      "recordings",
///      "causes": [{"effect", "joint", "parameters": {name: {"value", "sigma", "unit", "at_bound"}},
///                  "probability", "loss", "moves": {"joints": [{"rms", "largest"}], "tip": {"rms",
///                  "largest"}}, "gain": {"channel", "unit", "rms_before", "rms_after", "before", "after",
///                  "interval"}}],
///      "also_measurable": [as causes], "material": {"angle", "length"},
///      "posterior": [{"effects": [{"effect", "joint"}], "probability"}],
///      "ties": [{"causes": [as above], "separate"}],
///      "next_experiment": {"motion", "duration", "distinguishes": [{"effect", "joint"}], "confusion_now",
///                          "confusion_after"} or null,
///      "refit": {name: {"nominal", "value", "sigma", "without", "unit", "moved", "at_bound"}},
///      "candidates": [{"effect", "joint", "round", "screened", "refitted", "reduction", "score",
///                      "probability"}],
///      "channels": [{"recording", "name", "unit", "joint", "nominal", "refitted", "extended", "before",
///                    "after", "gain"}],
///      "explainable", "processes", "lines", "filter", "stages", "notices"}
/// Intervals are 95 % intervals [low, high]. In a gain, "before" and "after" are intervals of the RMS, and
/// "interval" is that of rms_after / rms_before. In a channel, "nominal", "refitted" and "extended" are its
/// statistics under the three models, and "before" and "after" are the signatures of the refitted and of the
/// extended model, strongest first. Joints count from 1; 0 is the whole arm or a camera.
nlohmann::json jsonOf(const Report& report);
/// Cause as JSON, as in a report.
nlohmann::json jsonOf(const Cause& cause);

}  // namespace capstan::diagnosis
