#include "core/experiments/debridement_study.h"

#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/resource.h"
#include "core/experiments/require_option.h"
#include "core/math/dense.h"
#include "core/stats/proportion.h"

namespace capstan::experiments {
namespace {

constexpr double kTrained = 0.96;  ///< share of the progress after training

struct Mean {
  double value = 0.0, standard_error = 0.0;
};

Mean meanTime(const std::vector<FragmentRun>& runs) {
  const auto n = static_cast<double>(runs.size());
  Mean mean;
  if (runs.empty()) return mean;
  for (const FragmentRun& run : runs) mean.value += run.time / n;
  double squares = 0.0;
  for (const FragmentRun& run : runs) squares += std::pow(run.time - mean.value, 2);
  if (n > 1.0) mean.standard_error = std::sqrt(squares / (n - 1.0) / n);
  return mean;
}

std::filesystem::path orResource(const std::filesystem::path& path, const char* file) {
  return path.empty() ? base::resource(file) : path;
}

void checkOptions(const DebridementStudyOptions& options) {
  requireOption("threads", options.threads, 1, 256);
  checkTraining(options.training);
  checkArrival(options.arrival);
  checkDebridementTask(options.task);
  requireOption("fragments beyond", options.fragments_beyond, 1, 100'000);
  requireOption("beyond [m]", options.beyond, 0.0, 0.1);
}

void fill(DebridementStudyReport& report, const TrainedCorrection& trained) {
  report.motions = trained.motions;
  report.rows = trained.rows;
  report.screened = trained.screened;
  report.states = trained.states;
  report.kept = trained.kept;
  report.clock_offset = trained.clock_offset;
}

/// An arm and the correction trained on it.
struct TrainedArm {
  robot::Description robot;
  simulation::ToolTruth truth;
  TrainedCorrection trained;
};

/// Reads the files and trains a correction. Null when cancelled.
std::optional<TrainedArm> trainedArm(const DebridementStudyOptions& options, DebridementStudyReport& report,
                                     base::Progress& progress) {
  checkOptions(options);
  robot::Description robot =
      robot::readDescription(orResource(options.robot, "robots/raven2_left_tool.yaml"));
  simulation::ToolTruth truth =
      simulation::readToolTruth(orResource(options.truth, "truth/debridement.yaml"));
  TrainingOptions training = options.training;
  training.seed = training.correction.seed = training.cleaning.median.seed = options.seed;
  training.correction.threads = 1;  // another number would change the order of sums
  progress.report(0.0, "Recording motions");
  const std::vector<learning::RawMotion> motions = recordTraining(robot, truth, training, &progress);
  if ((report.cancelled = progress.cancelled())) return std::nullopt;
  TrainedCorrection trained = trainedOn(motions, training, &progress);
  fill(report, trained);
  if ((report.cancelled = progress.cancelled())) return std::nullopt;
  math::setDenseThreads(1);  // from here on methods run side by side
  return TrainedArm{std::move(robot), std::move(truth), std::move(trained)};
}

}  // namespace

DebridementSummary summaryOf(const std::vector<FragmentRun>& of) {
  DebridementSummary all;
  if (of.empty()) return all;
  const auto n = static_cast<double>(of.size());
  for (const FragmentRun& run : of) {
    ++all.fragments;
    all.grasped += run.grasped;
    all.cleared += run.cleared;
    all.refused += run.refused;
    all.moving += run.moving / n;
    all.observations += run.observations / n;
    all.off += run.off / n;
  }
  const Mean mean = meanTime(of);
  all.time = mean.value;
  all.time_interval = {mean.value - stats::kNormal95 * mean.standard_error,
                       mean.value + stats::kNormal95 * mean.standard_error};
  all.success = stats::wilsonInterval(static_cast<std::uint64_t>(all.cleared),
                                      static_cast<std::uint64_t>(all.fragments));
  return all;
}

Speedup DebridementStudyReport::speedup() const {
  const auto& slow = runs[static_cast<std::size_t>(DebridementMethod::kReplanning)];
  const auto& fast = runs[static_cast<std::size_t>(DebridementMethod::kCorrected)];
  if (slow.size() < 2 || fast.size() < 2) return {};
  const Mean a = meanTime(slow), b = meanTime(fast);
  const double sigma = std::hypot(a.standard_error / a.value, b.standard_error / b.value);
  const double ratio = a.value / b.value, factor = std::exp(stats::kNormal95 * sigma);
  return {ratio, {ratio / factor, ratio * factor}};
}

DebridementStudyReport runArrival(const DebridementStudyOptions& options, base::Progress& progress) {
  DebridementStudyReport report;
  const std::optional<TrainedArm> arm = trainedArm(options, report, progress);
  if (!arm) return report;
  progress.report(kTrained, "Arriving at fragments");
  ArrivalOptions arrival = options.arrival;
  arrival.seed = options.seed;
  arrival.threads = options.threads;
  report.arrival = arrivalStudy(arm->robot, arm->truth, arm->trained.model, arrival, &progress);
  report.cancelled = progress.cancelled();
  return report;
}

DebridementStudyReport runDebridement(const DebridementStudyOptions& options, base::Progress& progress) {
  DebridementStudyReport report;
  const std::optional<TrainedArm> arm = trainedArm(options, report, progress);
  if (!arm) return report;
  progress.report(kTrained, "Debridement");
  DebridementTaskOptions task = options.task;
  task.seed = options.seed;
  DebridementTaskOptions beside = task;
  beside.fragments = options.fragments_beyond;
  beside.beside.x() -= options.beyond;
  base::parallelFor(2 * kDebridementMethods, options.threads, [&](std::size_t k) {
    const bool on = k < kDebridementMethods;
    const std::size_t method = on ? k : k - kDebridementMethods;
    (on ? report.runs : report.beyond)[method] =
        debridementTask(arm->robot, arm->truth, arm->trained.model, static_cast<DebridementMethod>(method),
                        on ? task : beside, &progress);
  });
  report.cancelled = progress.cancelled();
  return report;
}

}  // namespace capstan::experiments
