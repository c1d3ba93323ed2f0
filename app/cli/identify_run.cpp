#include "app/cli/identify_run.h"

#include <fmt/format.h>

#include "app/cli/console.h"
#include "core/base/error.h"
#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/experiments/identified.h"
#include "core/experiments/identify_trials.h"
#include "core/tracking/make_pipeline.h"

namespace capstan::cli {
namespace {

/// Throws base::InputError where nothing can be identified from the recording `file`.
void checkUsable(const identification::IdentificationData& data, const std::string& file) {
  if (data.excluded > 0 && data.motors.size() == 0)
    refuseFile(file, "has a motor encoder that failed from the beginning: nothing can be identified from it",
               "Give a recording with all motor encoders");
  if (data.openCount() == 0)
    refuseFile(file, "shows the marker nowhere, or has no registration: nothing can be identified from it",
               "Register the cameras (capstan-cli track --register), or give a recording with tip positions");
}

void runMethods(const IdentifyMethods& methods, const identification::IdentificationData& data,
                base::Progress& progress, Findings& found) {
  robot::Description nominal = data.robot;
  if (!methods.robot.empty()) nominal = robot::readDescriptionOrDefault(methods.robot);
  identification::IdentificationOptions options;
  if (!methods.options.empty())
    options = base::readYamlFile<identification::IdentificationOptions>(methods.options);
  if (methods.exact_camera) options.camera = {0.0, 0.0, 0.0};
  std::optional<identification::ParameterSet> set;
  try {
    set.emplace(nominal, methods.parameters, options.parameters);
  } catch (const base::InputError& error) {
    refuseOption("--parameters", error.fault().value, error.fault().reason, error.fault().remedy);
  }
  if (progress.cancelled()) return;
  found.identified = experiments::identifyRecording(data, *set,
                                                    {.dual = methods.method != "batch",
                                                     .batch = methods.method != "dual-ukf",
                                                     .camera = options.camera,
                                                     .threads = methods.threads},
                                                    progress);
}

}  // namespace

void CollectedRecordings::add(tracking::Source& source, const std::string& file, base::Progress& progress) {
  identification::IdentificationData more = identification::collect(source, &progress);
  if (!file.empty() && !more.cancelled) checkUsable(more, file);
  truth = source.info().truth;
  if (!data) tracking = tracking::trackingOptionsOf(source.info());
  if (data)
    identification::append(*data, more);
  else
    data = std::move(more);
}

double Findings::delay() const {
  const bool by_batch = *identified->choice.method == experiments::Method::kBatch;
  return (by_batch ? identified->batch->camera : identified->dual->camera).delay;
}

TrueValues Findings::trueValues() const {
  return truth.empty() ? TrueValues{} : experiments::trueValues(truth, recorded, identified->set);
}

std::optional<Findings> identifyCollected(const CollectedRecordings& recordings,
                                          const IdentifyMethods& methods, base::Progress& progress) {
  const identification::IdentificationData& data = *recordings.data;
  if (data.openCount() == 0 && !progress.cancelled())
    refuseOption("REC", data.title, "shows the marker nowhere",
                 "Give a recording in which cameras see the tip");
  Findings found;
  found.truth = recordings.truth;
  found.tracking = recordings.tracking;
  found.excluded = data.excluded;
  found.used = data.motors.size();
  found.recorded = data.robot;
  found.duration = data.duration();
  runMethods(methods, data, progress, found);
  if (progress.cancelled()) return std::nullopt;
  return found;
}

nlohmann::json documentOf(const Findings& found) {
  const experiments::Identified& identified = *found.identified;
  const TrueValues truth = found.trueValues();
  nlohmann::json document = {{"motor_samples_excluded", found.excluded}};
  if (identified.dual) document["dual_ukf"] = jsonOf(*identified.dual, truth);
  if (identified.batch) document["batch"] = jsonOf(*identified.batch, truth);
  const auto& method = identified.choice.method;
  document["result"] = method ? nlohmann::json(base::nameOf(*method)) : nlohmann::json();
  return document;
}

std::string excludedWords(const Findings& found) {
  if (found.excluded == 0) return {};
  return fmt::format("{} of {} motor samples excluded: an encoder had failed or gave no number",
                     found.excluded, found.excluded + found.used);
}

std::string identifiedRobotText(const Findings& found, const std::vector<std::string>& recordings) {
  experiments::RobotOrigin origin;
  origin.recordings = recordings;
  origin.duration = found.duration;
  origin.method = base::nameOf(*found.identified->choice.method);
  origin.values = valueLines(found.identified->estimates());
  origin.software = base::software();
  return experiments::identifiedRobotText(found.identified->set.nominal(), found.identified->robot(), origin);
}

std::string trackingOptionsText(const Findings& found) {
  tracking::TrackingOptions options = found.tracking;
  options.camera_delay += found.delay();
  return "# Tracking options with the camera's delay as identified (track --options).\n" +
         base::writeYaml(options);
}

}  // namespace capstan::cli
