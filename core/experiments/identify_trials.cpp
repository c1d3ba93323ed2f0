#include "core/experiments/identify_trials.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/identified.h"
#include "core/experiments/motion_collector.h"
#include "core/identification/batch.h"
#include "core/identification/delay_passes.h"
#include "core/identification/dual_ukf.h"
#include "core/identification/identification_data.h"
#include "core/simulation/truth.h"

namespace capstan::experiments {
namespace {

using identification::IdentificationData;

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

struct Collected {
  IdentificationData data;
  TrialMotion motion;
  TrialInputs inputs;
  robot::Description nominal;
};

Collected collectTrial(const TrialSetup& setup, base::Progress& progress) {
  TrialSource source(setup);
  Collected collected;
  collected.motion.name = setup.spec.name;
  MotionCollector motion(source, collected.motion);
  collected.data = identification::collect(
      source, &progress,
      [&](const tracking::Sample&, const tracking::Snapshot& snapshot) { motion.take(snapshot); });
  motion.finish();
  collected.inputs = source.inputs();
  collected.nominal = source.nominal();
  if (!collected.data.cancelled && collected.data.openCount() == 0)
    throw base::InputError({setup.recording, 0, "trial", setup.spec.name,
                            "shows the marker nowhere, or has no registration: nothing can be identified "
                            "from it",
                            "Register the cameras, or give a trial with tip positions"});
  return collected;
}

std::vector<Collected> collectAll(const std::vector<TrialSetup>& trials, int threads,
                                  const base::ProgressSlice& progress) {
  std::vector<Collected> all(trials.size());
  std::vector<base::Job> jobs;
  for (std::size_t i = 0; i < trials.size(); ++i)
    jobs.push_back({trials[i].spec.name, trials[i].weight(),
                    [&trials, &all, i](base::Progress& own) { all[i] = collectTrial(trials[i], own); }});
  base::doAll(jobs, threads, progress);
  return all;
}

ParameterEstimate estimateOf(const identification::Estimate& estimate) {
  return {estimate.value(), estimate.valueSigma(), estimate.low(),
          estimate.high(),  estimate.seen,         estimate.advice};
}

Eigen::Matrix<double, 7, 1> poseVector(const identification::CameraPose& pose) {
  Eigen::Matrix<double, 7, 1> all;
  all << pose.rotation, pose.shift, pose.delay;
  return all;
}

/// Writes the estimates of a method, or notes that it has none.
template <class Report>
void takeEstimates(const Report& report, bool usable, ParameterEstimate IdentifiedParameter::*which,
                   IdentificationResult& result) {
  for (std::size_t i = 0; i < result.parameters.size(); ++i) {
    ParameterEstimate& estimate = result.parameters[i].*which;
    if (usable)
      estimate = estimateOf(report.estimates[i]);
    else
      estimate.advice = fmt::format("the method found nothing ({})", base::nameOf(report.end));
  }
}

void take(const identification::ParameterSet& set, IdentificationResult& result) {
  for (const identification::Parameter& parameter : set.all()) {
    IdentifiedParameter& one = result.parameters.emplace_back();
    one.name = parameter.name();
    one.words = parameter.words();
    one.unit = parameter.unit();
    one.scale = parameter.scale();
    one.nominal = parameter.nominal;
  }
}

void take(const identification::DualUkfReport& report, const identification::ParameterSet& set, double start,
          IdentificationResult& result) {
  for (std::size_t index = 0; index < report.estimates.size(); ++index) {
    IdentifiedParameter& one = result.parameters[index];
    one.settled_at = report.convergence[index].settled_at;
    one.convergence = progressWords(report.convergence[index], report.estimates[index]);
  }
  for (const identification::TracePoint& point : report.trace) {
    ParameterTracePoint& line = result.trace.emplace_back();
    line.t = point.t - start;
    for (int i = 0; i < set.size(); ++i) {
      line.value.push_back(set.value(i, point.log(i)));
      line.sigma.push_back(line.value.back() * point.sigma(i));
    }
  }
  result.dual_correlation = report.correlation;
  result.dual_end = base::nameOf(report.end);
  result.dual_observations = report.observations;
  result.dual_nis = report.nis;
  result.dual_seconds = report.seconds;
}

void take(const identification::BatchReport& report, IdentificationResult& result) {
  result.batch_correlation = report.correlation;
  result.batch_end = base::nameOf(report.end);
  result.batch_observations = report.observations;
  result.batch_iterations = report.iterations;
  result.batch_residual = report.residual_after;
  result.batch_seconds = report.seconds;
}

void identify(const IdentificationData& data, const identification::ParameterSet& set,
              const IdentificationSetup& setup, int threads, base::Progress& progress,
              IdentificationResult& result) {
  const auto dual =
      identification::identifyDualUkfInPasses(data, set, {.camera = setup.options.camera}, &progress);
  if (progress.cancelled()) return;
  take(set, result);
  take(dual, set, data.motors.t.empty() ? 0.0 : data.motors.t.front(), result);
  identification::BatchOptions options{.camera = setup.options.camera, .shooting = {.threads = threads}};
  const bool dual_usable = choose(Method::kDualUkf, &dual, nullptr).method.has_value();
  if (dual_usable) options.start = identification::logsOf(dual.estimates);
  const auto batch = identification::identifyBatchInPasses(data, set, options, &progress);
  if (progress.cancelled()) return;
  take(batch, result);
  const bool batch_usable = choose(Method::kBatch, nullptr, &batch).method.has_value();
  takeEstimates(dual, dual_usable, &IdentifiedParameter::dual_ukf, result);
  takeEstimates(batch, batch_usable, &IdentifiedParameter::batch, result);
  const Choice choice = choose(setup.spec.robot, &dual, &batch);
  result.method = choice.method.value_or(setup.spec.robot);
  result.found = choice.method.has_value();
  result.choice = choice.words;
  const bool by_dual = result.method == Method::kDualUkf;
  result.camera = poseVector(by_dual ? dual.camera : batch.camera);
  result.camera_sigma = poseVector(by_dual ? dual.camera_sigma : batch.camera_sigma);
}

RobotOrigin originOf(const std::vector<TrialSetup>& trials, const std::string& software,
                     const IdentificationResult& result) {
  RobotOrigin origin;
  for (const TrialSetup& trial : trials)
    origin.recordings.push_back(
        trial.recording.empty()
            ? fmt::format("trial {} (simulated, seed {})", trial.spec.name, trial.spec.seed)
            : fmt::format("trial {} ({})", trial.spec.name, trial.inputs.recording));
  origin.duration = result.duration;
  origin.method = base::nameOf(result.method);
  origin.software = software;
  for (const IdentifiedParameter& parameter : result.parameters) {
    const ParameterEstimate& estimate = result.chosen(parameter);
    origin.values.push_back(valueLine(parameter.name, parameter.scale * estimate.value,
                                      parameter.scale * estimate.sigma, parameter.unit, estimate.seen));
  }
  return origin;
}

}  // namespace

IdentificationSetup setUpIdentification(const Specification& specification,
                                        const robot::Description& nominal) {
  IdentificationSetup setup;
  setup.spec = specification.identification;
  if (!setup.spec.options.empty())
    setup.options =
        base::readYamlFile<identification::IdentificationOptions>(specification.resolved(setup.spec.options));
  try {
    (void)identification::ParameterSet(nominal, setup.spec.parameters, setup.options.parameters);
  } catch (const base::InputError& error) {
    if (specification.file.empty()) throw;  // requested by an option, which has that name
    throw base::InputError({specification.file.string(), specification.lineOf({}, "identification"),
                            "identification.parameters", setup.spec.parameters, error.fault().reason,
                            error.fault().remedy});
  }
  setup.fingerprint = {{"format", 3},
                       {"parameters", setup.spec.parameters},
                       {"method", std::string(base::nameOf(setup.spec.robot))},
                       {"options", base::writeYaml(setup.options)}};
  return setup;
}

std::vector<double> trueValues(const std::string& truth, const robot::Description& nominal,
                               const identification::ParameterSet& set) {
  if (truth.empty()) return std::vector<double>(static_cast<std::size_t>(set.size()), kNone);
  const simulation::Truth parsed = simulation::parseTruth(truth, "truth of the recording");
  std::vector<double> values;
  for (const identification::Parameter& parameter : set.all()) {
    const auto joint = static_cast<std::size_t>(parameter.joint);
    const simulation::JointTruth& is = parsed.joints[joint];
    const robot::Drive& drive = nominal.drives[joint];
    switch (parameter.quantity) {
      case identification::Quantity::kLinkRadius:
        values.push_back(is.link_radius.value_or(drive.link_radius));
        break;
      case identification::Quantity::kStiffness:
        values.push_back(is.stiffness_factor * drive.cable_stiffness);
        break;
      case identification::Quantity::kDamping:
        values.push_back(is.damping_factor * drive.cable_damping);
        break;
      case identification::Quantity::kFriction:
        values.push_back(nominal.joints[joint].friction.coulomb);
        break;
    }
  }
  return values;
}

IdentificationResult identifyTrials(const std::vector<TrialSetup>& trials, const IdentificationSetup& setup,
                                    int threads, const base::ProgressSlice& progress) {
  IdentificationResult result;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Collected> all = collectAll(trials, threads, progress.part(0.0, 0.5));
  result.collect_seconds = secondsSince(begin);
  if (progress.whole.cancelled()) return result;
  IdentificationData data = std::move(all.front().data);
  for (std::size_t i = 1; i < all.size(); ++i) identification::append(data, all[i].data);
  result.method = setup.spec.robot;
  result.inputs = all.front().inputs;
  result.seed = trials.front().recording.empty() ? trials.front().spec.seed : 0;
  result.duration = data.duration();
  for (const TrialSetup& trial : trials) result.recordings.push_back(trial.spec.name);
  for (Collected& one : all) result.motions.push_back(std::move(one.motion));
  const identification::ParameterSet set(data.robot, setup.spec.parameters, setup.options.parameters);
  base::doAll({{"identification", 1.0,
                [&](base::Progress& own) { identify(data, set, setup, threads, own, result); }}},
              1, progress.part(0.5, 1.0));
  if (progress.whole.cancelled()) return result;
  const std::vector<double> truth = trueValues(result.inputs.truth, all.front().nominal, set);
  for (std::size_t i = 0; i < result.parameters.size(); ++i) result.parameters[i].truth = truth[i];
  if (result.found)
    result.robot = identifiedRobotText(data.robot, withIdentified(data.robot, result),
                                       originOf(trials, setup.software, result));
  return result;
}

}  // namespace capstan::experiments
