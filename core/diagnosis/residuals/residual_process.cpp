#include "core/diagnosis/residuals/residual_process.h"
#include "core/diagnosis/residuals/process_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/base/random.h"
#include "core/diagnosis/residuals/ard_process.h"
#include "core/diagnosis/residuals/decimated_residual.h"
#include "core/diagnosis/residuals/process_parts.h"
#include "core/diagnosis/residuals/signature.h"
#include "core/stats/rms.h"

namespace capstan::diagnosis {
namespace {

constexpr int kTrial = 6;        // iterations from each start, before the better one is continued
constexpr double kShows = 0.03;  // Signature::share above which a variable starts with the short length scale
constexpr double kShort = 1.0, kLong = 8.0;  // length scales of the second start [spread of the variable]

/// The decimated residual, standardised, with its variables.
struct Points {
  ProcessInputs inputs;
  Eigen::VectorXd e;                 ///< mean 0, variance 1
  std::vector<std::size_t> segment;  ///< segment of each point
  std::vector<const Variable*> variables;
  Eigen::VectorXd spread;  ///< divisor of each variable; for angles 1 if they are in rad
  double scale = 1.0;      ///< standard deviation of the residual before scaling [the channel's unit]
};

Channel keptOf(const Channel& channel, const Decimated& thin) {
  Channel kept = channel;
  kept.period = thin.period;
  kept.residual = thin.residual;
  kept.t.clear(), kept.row.clear(), kept.measured.clear(), kept.simulated.clear();
  for (const std::size_t i : thin.samples) kept.t.push_back(channel.t[i]), kept.row.push_back(channel.row[i]);
  return kept;
}

void addVariable(Points& points, const Variable& variable, std::vector<double> values) {
  const bool angle = variable.period > 0.0;
  const double spread = stats::standardDeviation(values);
  if (!(spread > 0.0)) return;
  const double unit = angle ? variable.period / (2.0 * std::numbers::pi) : spread;
  const double centre = angle ? 0.0 : stats::mean(values);
  const Eigen::Index d = points.inputs.x.cols();
  points.inputs.x.conservativeResize(static_cast<Eigen::Index>(values.size()), d + 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    points.inputs.x(static_cast<Eigen::Index>(i), d) = (values[i] - centre) / unit;
  points.inputs.angle.push_back(angle);
  points.spread.conservativeResize(d + 1);
  points.spread(d) = unit;
  points.variables.push_back(&variable);
}

Points pointsOf(const Channel& channel, const std::vector<Variable>& variables, std::size_t most) {
  Points points;
  const Channel kept = keptOf(channel, decimate(channel, most));
  points.scale = stats::standardDeviation(kept.residual);
  const double mean = stats::mean(kept.residual);
  points.e.resize(static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i)
    points.e(static_cast<Eigen::Index>(i)) =
        points.scale > 0.0 ? (kept.residual[i] - mean) / points.scale : 0.0;
  const double length = std::max(timeBlocks(channel).length, (kept.t.back() - kept.t.front()) / kSegments);
  for (const double t : kept.t)
    points.segment.push_back(static_cast<std::size_t>((t - kept.t.front()) / length + 1e-9));
  points.inputs.t = Eigen::Map<const Eigen::VectorXd>(kept.t.data(), points.e.size());
  points.inputs.x.resize(points.e.size(), 0);
  for (const Variable& variable : variables)
    if (concerns(variable, channel)) addVariable(points, variable, variable.at(kept));
  return points;
}

struct Half {
  std::vector<Eigen::Index> rows;
  ProcessInputs inputs;
  Eigen::VectorXd e;
};

Half halfOf(const Points& points, std::size_t parity) {
  Half half;
  for (std::size_t i = 0; i < points.segment.size(); ++i)
    if (points.segment[i] % 2 == parity) half.rows.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(half.rows.size());
  half.inputs.t.resize(n);
  half.inputs.x.resize(n, points.inputs.variables());
  half.inputs.angle = points.inputs.angle;
  half.e.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index row = half.rows[static_cast<std::size_t>(i)];
    half.inputs.t(i) = points.inputs.t(row);
    half.inputs.x.row(i) = points.inputs.x.row(row);
    half.e(i) = points.e(row);
  }
  return half;
}

/// Two starts: equal length scales, and short length scales where a signature shows a dependence.
std::array<ProcessParameters, 2> startsOf(const Points& points, const Channel& channel) {
  const Eigen::Index d = points.inputs.variables();
  ProcessParameters alike(kLengths + d);
  alike.setConstant(std::log(std::max(1.5, std::sqrt(static_cast<double>(d)))));
  alike(kSignal) = alike(kWhite) = std::log(0.6), alike(kSlow) = std::log(0.4);
  alike(kMemory) = std::log(0.3);
  ProcessParameters shown = alike;
  const TimeBlocks blocks = timeBlocks(channel);
  for (Eigen::Index v = 0; v < d; ++v) {
    const double share = signatureOf(channel, blocks, *points.variables[static_cast<std::size_t>(v)]).share;
    shown(kLengths + v) = std::log(share > kShows ? kShort : kLong);
  }
  return {alike, shown};
}

ProcessParameters bestFit(const ArdProcess& process, const std::array<ProcessParameters, 2>& starts,
                          int iterations, const base::Progress* progress, const std::function<void()>& part) {
  ProcessParameters best;
  double least = std::numeric_limits<double>::infinity();
  for (const ProcessParameters& start : starts) {
    const ProcessParameters tried = process.fit(start, kTrial, progress);
    const double value = process.objective(tried, nullptr).value_or(least);
    if (best.size() == 0 || value < least) best = tried, least = value;
    part();
  }
  best = process.fit(best, iterations, progress);
  part();
  return best;
}

/// Sums of held-out squared errors over one segment.
struct Score {
  double variance = 0.0, error = 0.0;
  Eigen::ArrayXd gain;  ///< per variable: (squared error with shuffled values − squared error) / 2
};

Eigen::VectorXd predict(const Eigen::MatrixXd& distances, const Eigen::VectorXd& alpha,
                        const ProcessParameters& parameters) {
  return std::exp(2.0 * parameters(kSignal)) * ((-0.5 * distances.array()).exp().matrix() * alpha);
}

/// Scores the half `tested` with the process fitted to the half `fitted`.
void score(const Half& fitted, double mean, const ProcessParameters& parameters, const Half& tested,
           const std::vector<std::size_t>& segment, const ProcessOptions& options, base::Random& random,
           std::vector<Score>& scores) {
  const ArdProcess process(fitted.inputs, fitted.e.array() - mean);
  const Eigen::VectorXd alpha = process.weights(parameters);
  const Eigen::MatrixXd distances = scaledDistances(tested.inputs, fitted.inputs, parameters);
  const Eigen::ArrayXd target = tested.e.array() - mean;
  const Eigen::ArrayXd error = (target - predict(distances, alpha, parameters).array()).square();
  const auto at = [&](Eigen::Index i) -> Score& {
    return scores[segment[static_cast<std::size_t>(tested.rows[static_cast<std::size_t>(i)])]];
  };
  for (Eigen::Index i = 0; i < error.size(); ++i)
    at(i).variance += target(i) * target(i), at(i).error += error(i);
  std::vector<Eigen::Index> order(tested.rows.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  for (Eigen::Index v = 0; v < tested.inputs.variables(); ++v) {
    const bool angle = tested.inputs.angle[static_cast<std::size_t>(v)];
    const double scale = std::exp(-2.0 * parameters(kLengths + v));
    for (int shuffle = 0; shuffle < options.shuffles; ++shuffle) {
      std::shuffle(order.begin(), order.end(), random.engine());
      Eigen::MatrixXd moved = distances;
      for (Eigen::Index c = 0; c < moved.cols(); ++c)
        for (Eigen::Index r = 0; r < moved.rows(); ++r) {
          const double known = fitted.inputs.x(c, v);
          const double other = tested.inputs.x(order[static_cast<std::size_t>(r)], v);
          moved(r, c) += scale * (squaredDistance(other, known, angle) -
                                  squaredDistance(tested.inputs.x(r, v), known, angle));
        }
      const Eigen::ArrayXd worse = (target - predict(moved, alpha, parameters).array()).square() - error;
      for (Eigen::Index i = 0; i < worse.size(); ++i) at(i).gain(v) += 0.5 * worse(i) / options.shuffles;
    }
  }
}

std::string wordsOf(const ResidualProcess& process) {
  std::string words;
  for (const ProcessVariable& variable : process.variables) {
    if (process.explained < kWeakly || variable.relevance < kWeakly ||
        variable.relevance < 2.0 * variable.sigma)
      continue;
    const char* how = variable.relevance >= kStrongly  ? "strongly"
                      : variable.relevance >= kClearly ? "clearly"
                                                       : "weakly";
    words += fmt::format("{} on {}, {}", words.empty() ? "depends" : ";", variable.name, how);
  }
  return words.empty() ? "depends on none of the variables" : words;
}

void judge(ResidualProcess& result, const Points& points, const ProcessParameters& parameters,
           const std::vector<Score>& scores) {
  double variance = 0.0, error = 0.0;
  for (const Score& s : scores) variance += s.variance, error += s.error;
  result.explained = 1.0 - error / variance;
  result.amplitude = points.scale * std::exp(parameters(kSignal));
  result.noise = points.scale * std::hypot(std::exp(parameters(kWhite)), std::exp(parameters(kSlow)));
  result.lasting = points.scale * std::exp(parameters(kSlow));
  result.memory = std::exp(parameters(kMemory));
  for (Eigen::Index v = 0; v < points.inputs.variables(); ++v) {
    const Variable& variable = *points.variables[static_cast<std::size_t>(v)];
    double gain = 0.0, scatter = 0.0;
    for (const Score& s : scores) gain += s.gain(v);
    const double relevance = gain / variance;
    for (const Score& s : scores) scatter += std::pow(s.gain(v) - relevance * s.variance, 2);
    result.variables.push_back({variable.kind, variable.joint, variable.name, variable.unit,
                                points.spread(v) * std::exp(parameters(kLengths + v)), relevance,
                                std::sqrt(scatter) / variance});
  }
  std::stable_sort(
      result.variables.begin(), result.variables.end(),
      [](const ProcessVariable& a, const ProcessVariable& b) { return a.relevance > b.relevance; });
  result.words = wordsOf(result);
}

}  // namespace

ResidualProcess residualProcess(const Channel& channel, const std::vector<Variable>& variables,
                                const ProcessOptions& options, const base::Progress* progress) {
  return residualProcessInParts(channel, variables, options, progress, [] {});
}

ResidualProcess residualProcessInParts(const Channel& channel, const std::vector<Variable>& variables,
                                       const ProcessOptions& options, const base::Progress* progress,
                                       const std::function<void()>& part) {
  ResidualProcess result;
  result.channel = channel.name;
  result.words = "is too short, or never changes";
  if (channel.size() < kFewestForProcess) return result;
  const Points points = pointsOf(channel, variables, options.points);
  result.points = static_cast<std::size_t>(points.e.size());
  if (!(points.scale > 0.0) || points.inputs.variables() == 0) return result;
  const std::array<ProcessParameters, 2> starts = startsOf(points, channel);
  std::vector<Score> scores(points.segment.back() + 1);
  for (Score& s : scores) s.gain = Eigen::ArrayXd::Zero(points.inputs.variables());
  ProcessParameters mean_found = ProcessParameters::Zero(starts[0].size());
  base::Random random(options.seed, "remainder process");
  for (std::size_t parity = 0; parity < 2; ++parity) {
    const Half fitted = halfOf(points, parity), tested = halfOf(points, 1 - parity);
    if (fitted.rows.size() < kFewestForProcess / 4 || tested.rows.empty()) return result;
    const double mean = fitted.e.mean();
    const ArdProcess process(fitted.inputs, fitted.e.array() - mean);
    const ProcessParameters found = bestFit(process, starts, options.iterations, progress, part);
    mean_found += 0.5 * found;
    score(fitted, mean, found, tested, points.segment, options, random, scores);
    part();
  }
  const ArdProcess whole(points.inputs, points.e);
  const ProcessParameters parameters = whole.fit(mean_found, options.iterations / 4, progress);
  result.end = progress && progress->cancelled() ? ProcessEnd::kCancelled : ProcessEnd::kDone;
  if (result.end == ProcessEnd::kDone) judge(result, points, parameters, scores);
  return result;
}

}  // namespace capstan::diagnosis
