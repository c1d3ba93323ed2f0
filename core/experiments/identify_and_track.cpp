#include "core/experiments/identify_and_track.h"

#include "core/base/error.h"
#include "core/base/workers.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::experiments {
namespace {

using identification::IdentificationData;

/// Reason why nothing can be identified from `data`; else empty.
std::string faultOf(const IdentificationData& data) {
  if (data.motors.size() == 0) return "no motor encoder gave valid numbers";
  if (data.openCount() == 0) return "the cameras saw the marker nowhere, or are not registered";
  return {};
}

void identify(const IdentificationData& data, base::Progress& progress, IdentifyAndTrack& result) {
  try {
    const identification::ParameterSet set(data.robot, identification::kDefaultParameters);
    Identified found = identifyRecording(data, set, {}, progress);
    if (progress.cancelled()) return;
    if (!found.choice.method)
      result.fault = found.choice.words;
    else if (!found.anySeen())
      result.fault = "this motion shows no parameter";
    result.identified = std::move(found);
  } catch (const base::InputError& error) {  // a robot whose parameters cannot be identified
    result.fault = error.what();
  }
}

void track(tracking::Source& recording, const tracking::TrackingOptions& options, base::Progress& progress,
           IdentifyAndTrack& result) {
  tracking::SourceInfo info = recording.info();
  info.robot = result.identified->robot();
  tracking::TrackingPipeline pipeline = tracking::makePipeline(info, options);
  tracking::TrackReport report = tracking::trackAll(recording, pipeline, &progress, info.duration);
  if (!report.cancelled) result.tracked = std::move(report);
}

}  // namespace

IdentifyAndTrack identifyAndTrack(const IdentificationData& data, tracking::Source& recording,
                                  const tracking::TrackingOptions& options, base::Progress& progress) {
  IdentifyAndTrack result;
  result.duration = data.duration();
  result.fault = faultOf(data);
  if (!result.fault.empty()) return result;
  base::doAll({{"identifying", 1.0, [&](base::Progress& own) { identify(data, own, result); }},
               {"tracking again", 1.0,
                [&](base::Progress& own) {
                  if (result.fault.empty() && result.identified) track(recording, options, own, result);
                }}},
              1, {progress});
  result.cancelled = progress.cancelled();
  if (!result.cancelled) progress.report(1.0, "tracking again");
  return result;
}

}  // namespace capstan::experiments
