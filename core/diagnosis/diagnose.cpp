#include "core/diagnosis/diagnose.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/base/error.h"
#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/filter_gain.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/displacement.h"
#include "core/diagnosis/selection/explainable.h"
#include "core/diagnosis/selection/gains.h"
#include "core/diagnosis/selection/horizons.h"
#include "core/diagnosis/selection/spectral_line.h"
#include "core/diagnosis/selection/verdict.h"

namespace capstan::diagnosis {
namespace {

constexpr double kMoved = 2.0;        // distance from nominal that counts as moved [sigmas]
constexpr double kFilterFrom = 0.95;  // progress where the comparison of Kalman filters begins
constexpr double kAtBound = 1e-6;     // distance of u from its bound that counts as at the bound

class Clock {
 public:
  explicit Clock(std::vector<Stage>& stages) : stages_(stages) {}
  void lap(const char* name) {
    const auto now = std::chrono::steady_clock::now();
    stages_.push_back({name, std::chrono::duration<double>(now - last_).count()});
    last_ = now;
  }

 private:
  std::vector<Stage>& stages_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void check(const std::vector<Evidence>& recordings, const robot::Description& robot,
           const DiagnosisOptions& options) {
  if (recordings.empty())
    throw base::InputError({"", 0, "recordings", "", "there are none", "Give at least one recording"});
  for (const Evidence& evidence : recordings) {
    const std::string& name = evidence.file.empty() ? evidence.title : evidence.file;
    if (evidence.joints != robot.size())
      throw base::InputError({name, 0, "joints", std::to_string(evidence.joints),
                              fmt::format("the robot has {}", robot.size()),
                              "Give the robot file of this robot"});
    if (evidence.drive != robot.drive)
      throw base::InputError({name, 0, "drive", "", "was read for another kind of drive than the robot's",
                              "Read it with the robot file's drive"});
  }
  for (const std::string& name : options.only)
    if (!hypothesisNamed(name))
      throw base::InputError(
          {"", 0, "only", name, "is the name of no hypothesis", "Choose one of the library"});
}

/// Nominal parameters come first in every model, in the same order.
void addRefit(const FitData& data, const Selection& s, Report& report) {
  const Eigen::MatrixXd covariance = covarianceOf(data, s.best, s.weighting);
  const FitModel& model = s.best.model;
  for (int k = 0; k < model.baseSize(); ++k) {
    const FitParameter& p = model.parameters()[static_cast<std::size_t>(k)];
    const double u = s.best.u[k], value = p.value(u);
    RefitNumber number{.name = fmt::format("{} of joint {}", p.name, p.joint),
                       .unit = p.unit,
                       .nominal = p.start,
                       .value = value,
                       .sigma = p.valueSigma(u, std::sqrt(covariance(k, k))),
                       .value_without = p.value(s.base.u[k])};
    number.at_bound = std::abs(u - p.u(p.low)) < kAtBound || std::abs(u - p.u(p.high)) < kAtBound;
    number.moved = std::abs(value - p.start) > kMoved * number.sigma;
    report.refit.push_back(std::move(number));
  }
}

/// Displacements by the nominal parameters that the refit moved.
void addRefitMoves(const FitData& data, const Selection& s, const robot::Description& nominal,
                   Report& report) {
  std::vector<int> moved;
  for (std::size_t k = 0; k < report.refit.size(); ++k)
    if (report.refit[k].moved) moved.push_back(static_cast<int>(k));
  const std::vector<Displacements> moves = displacementsByRefit(data, s.best, moved, nominal);
  for (std::size_t i = 0; i < moved.size(); ++i) {
    RefitNumber& number = report.refit[static_cast<std::size_t>(moved[i])];
    number.moves = moves[i];
    number.material = isMaterial(moves[i], report.material);
  }
}

/// Signatures of the channel, strongest first.
std::vector<Signature> sortedSignatures(const Channel& channel, const std::vector<Variable>& variables) {
  std::vector<Signature> signatures = signaturesOf(channel, variables);
  std::stable_sort(signatures.begin(), signatures.end(),
                   [](const Signature& a, const Signature& b) { return a.share > b.share; });
  return signatures;
}

class Assembly {
 public:
  Assembly(const std::vector<Evidence>& recordings, const robot::Description& nominal, const FitData& data,
           const Selection& selection, Report& report)
      : recordings_(recordings), nominal_(nominal), data_(data), s_(selection), report_(report) {}

  void addChannels() {
    const robot::ChainModel nominal(nominal_), base = s_.base.model.chain(s_.base.u),
                                               best = s_.best.model.chain(s_.best.u);
    for (int r = 0; r < data_.recordings(); ++r) {
      const ChainSimulation& simulation = data_.simulation(r);
      const Evidence& evidence = simulation.evidence();
      report_.recordings.push_back(evidence.title);
      const SimulatedMotion before = simulation.motion(base), after = simulation.motion(best);
      const auto first = residualsOf(evidence, simulation.motion(nominal));
      const auto refitted = residualsOf(evidence, before), extended = residualsOf(evidence, after);
      const auto variables_before = variablesOf(evidence, before, nominal_);
      const auto variables_after = variablesOf(evidence, after, nominal_);
      for (std::size_t c = 0; c < refitted.size() && c < first.size() && c < extended.size(); ++c) {
        ChannelReport channel;
        channel.recording = r;
        channel.nominal = first[c];
        channel.refitted = refitted[c];
        channel.extended = extended[c];
        channel.nominal_statistics = statisticsOf(channel.nominal);
        channel.refitted_statistics = statisticsOf(channel.refitted);
        channel.extended_statistics = statisticsOf(channel.extended);
        channel.before = sortedSignatures(channel.refitted, variables_before);
        channel.after = sortedSignatures(channel.extended, variables_after);
        channel.gain = gainOf(data_, s_.base_squares, s_.best_squares, placeOf(r, channel.refitted));
        report_.channels.push_back(std::move(channel));
      }
    }
  }

  /// Spectral lines of the best model's residual, simulated with the horizon of the fit.
  void addLines() {
    std::size_t place = 0;
    for (int r = 0; r < data_.recordings(); place += data_.simulation(r).compared().channels.size(), ++r) {
      const Compared& compared = data_.simulation(r).compared();
      for (std::size_t c = 0; c < compared.channels.size(); ++c) {
        Channel channel;
        channel.name = compared.channels[c].name;
        double squares = 0.0;
        for (std::size_t i = 0; i < compared.channel.size(); ++i) {
          if (static_cast<std::size_t>(compared.channel[i]) != c) continue;
          channel.t.push_back(compared.t[i]);
          channel.residual.push_back(s_.best.e[data_.first(r) + static_cast<Eigen::Index>(i)]);
          squares += channel.residual.back() * channel.residual.back();
        }
        if (channel.t.empty()) continue;
        const double rms = std::sqrt(squares / static_cast<double>(channel.t.size()));
        if (rms * rms < mostByChance(data_, s_, static_cast<Eigen::Index>(place + c))) continue;
        if (auto line = spectralLine(channel)) report_.lines.push_back(*line);
      }
    }
  }

  /// Gaussian process of the residual of the channel whose RMS is largest relative to its noise.
  void addProcess(base::Progress* progress) {
    const ChannelReport* most = nullptr;
    for (const ChannelReport& channel : report_.channels) {
      const auto beyond = [](const ChannelReport& c) {
        return c.extended_statistics.rms / std::max(c.extended_statistics.noise, 1e-12);
      };
      if (!most || beyond(channel) > beyond(*most)) most = &channel;
    }
    if (!most) return;
    const ChainSimulation& simulation = data_.simulation(most->recording);
    const SimulatedMotion motion = simulation.motion(s_.best.model.chain(s_.best.u));
    std::vector<Variable> variables = variablesOf(simulation.evidence(), motion, nominal_);
    std::erase_if(variables, [&](const Variable& v) { return !concerns(v, most->extended); });
    report_.processes.push_back(residualProcess(most->extended, variables, {}, progress));
  }

 private:
  std::vector<Channel> residualsOf(const Evidence& evidence, const SimulatedMotion& motion) const {
    return residualOf(evidence, motion, nominal_);
  }

  /// Index of the channel in FitData::channels().
  int placeOf(int recording, const Channel& channel) const {
    std::size_t place = 0;
    for (int r = 0; r < recording; ++r) place += data_.simulation(r).compared().channels.size();
    const auto& own = data_.simulation(recording).compared().channels;
    for (std::size_t c = 0; c < own.size(); ++c)
      if (own[c].joint == channel.joint && own[c].axis == channel.axis) return static_cast<int>(place + c);
    return static_cast<int>(place);
  }

  const std::vector<Evidence>& recordings_;
  const robot::Description& nominal_;
  const FitData& data_;
  const Selection& s_;
  Report& report_;
};

void addFilter(const std::vector<Evidence>& recordings, const robot::Description& nominal,
               const DiagnosisOptions& options, Report& report, base::Progress* progress) {
  FilterGainOptions filter;
  filter.threads = options.threads;
  filter.zero_per_recording = options.zeros == EncoderZeros::kOnePerRecording && recordings.size() > 1;
  const FilterGainReport gain =
      filterGain(recordings, {nominal, report.refitted, report.extended}, filter, progress);
  report.filter = gain.joints;
  report.notices.insert(report.notices.end(), gain.notices.begin(), gain.notices.end());
}

void addRobots(const Selection& s, Report& report) {
  report.refitted = s.base.model.refitted(s.base.u);
  report.extended = s.best.model.extended(s.best.u);
}

}  // namespace

Report diagnose(const std::vector<Evidence>& recordings, const robot::Description& nominal,
                const DiagnosisOptions& options, base::Progress* progress) {
  check(recordings, nominal, options);
  Report report;
  Clock clock(report.stages);
  if (progress) progress->report(progress->fraction(), "Preparing");
  const FitModel base(nominal, jointScales(recordings, nominal));
  clock.lap("prepare");
  const auto [fitted, selection] =
      selectOverHorizons(recordings, nominal, base, options.zeros, options.threads,
                         {.most_causes = options.most_causes,
                          .only = options.only,
                          .seed = options.seed,
                          .effort = options.effort},
                         progress);
  const FitData& data = *fitted;
  clock.lap("refit, screen and select");
  Assembly assembly(recordings, nominal, data, selection, report);
  report.candidates = selection.candidates;
  addRobots(selection, report);
  addRefit(data, selection, report);
  if (options.show) assembly.addChannels();
  clock.lap("show");
  assembly.addLines();
  report.material = options.material;
  if (options.show) addRefitMoves(data, selection, nominal, report);
  if (options.show || hasResidual(data, selection, options.material))
    report.explainable = explainableOf(data, selection, nominal, progress);
  clock.lap("explainable share");
  judge(data, selection, nominal, report);
  if (options.show && report.verdict == Verdict::kUnexplained) assembly.addProcess(progress);
  clock.lap("judge");
  if (options.show && (!report.ties.empty() || report.verdict == Verdict::kUnexplained)) {
    report.next =
        nextExperiment(data, recordings, selection, nominal, options.zeros, options.threads, progress);
    clock.lap("next experiment");
  }
  report.search_complete = selection.complete;
  if (!selection.complete)
    report.notices.push_back(
        fmt::format("The search for causes ended at its limit. Better combinations of causes may exist; "
                    "effort ×{:g} searches longer",
                    std::max(1.0, 2.0 * options.effort)));
  for (const Evidence& evidence : recordings)
    report.notices.insert(report.notices.end(), evidence.notices.begin(), evidence.notices.end());
  if (options.show && options.filter) {
    if (progress) progress->report(kFilterFrom, "Running the Kalman filter");
    addFilter(recordings, nominal, options, report, progress);
    clock.lap("filter");
  }
  report.cancelled = progress && progress->cancelled();
  return report;
}

}  // namespace capstan::diagnosis
