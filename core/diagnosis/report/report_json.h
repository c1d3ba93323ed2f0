#pragma once

#include <nlohmann/json.hpp>

#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// A report as JSON: numbers in SI to the last bit, not a number as null, as is the verdict of a report that
/// was cancelled; without the samples of channels and
/// without the robots, which are robot files.
///     {"verdict": "found|several|tie|nothing|unexplained", "summary", "explained", "cancelled",
///     "recordings",
///      "causes": [{"effect", "joint", "parameters": {name: {"value", "sigma", "unit"}}, "probability",
///                  "gain": {"channel", "unit", "rms_before", "rms_after", "before", "after", "interval"}}],
///      "ties": [{"causes": [as above], "separate"}],
///      "refit": {name: {"nominal", "value", "sigma", "unit", "moved", "at_bound"}},
///      "candidates": [{"effect", "joint", "round", "screened", "refitted", "reduction", "score",
///                      "probability"}],
///      "channels": [{"recording", "name", "unit", "joint", "nominal", "refitted", "extended", "before",
///                    "after", "gain"}],
///      "processes", "lines", "filter", "stages", "notices"}
/// Intervals are [low, high] of 95 %: "before" and "after" of the RMS, "interval" of after / before. A
/// channel's "nominal", "refitted" and "extended" are its statistics under the three models, its "before" and
/// "after" the signatures of the refitted and the extended one, strongest first. Joints count from 1; 0 is
/// the whole arm or a camera.
nlohmann::json jsonOf(const Report& report);
nlohmann::json jsonOf(const Cause& cause);

}  // namespace capstan::diagnosis
