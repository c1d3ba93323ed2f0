#include "core/diagnosis/selection/measured_regression.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/fit/held_out.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRests = 0.02;  // of the fastest motion: slower motion has no direction

struct Design {
  MatrixXd x;  ///< samples × columns, the constant first
  VectorXd y;
  std::vector<std::string> names;
  std::vector<int> fold, recording;
};

/// Samples of the joint's encoder channel in all recordings.
std::vector<Index> samplesOf(const FitData& data, int joint) {
  std::vector<Index> samples;
  for (std::size_t i = 0; i < data.channel().size(); ++i)
    if (data.channels()[static_cast<std::size_t>(data.channel()[i])].joint == joint)
      samples.push_back(static_cast<Index>(i));
  return samples;
}

int recordingOf(const FitData& data, Index sample) {
  int r = 0;
  while (r + 1 < data.recordings() && data.first(r + 1) <= sample) ++r;
  return r;
}

std::size_t rowAt(const Evidence& evidence, double t) {
  const auto after = std::lower_bound(evidence.t.begin(), evidence.t.end(), t);
  const auto row = static_cast<std::size_t>(after - evidence.t.begin());
  if (row == evidence.rows()) return row - 1;
  return row > 0 && t - evidence.t[row - 1] < evidence.t[row] - t ? row - 1 : row;
}

/// Direction of motion of the joint's motor, 0 at rest.
double directionAt(const std::vector<double>& speed, std::size_t row, double fastest) {
  return std::abs(speed[row]) < kRests * fastest ? 0.0 : std::copysign(1.0, speed[row]);
}

/// Names of the columns that every recording has; the values are those of valuesAt() in the same order.
std::vector<std::string> namesFor(const Evidence& evidence, int joint) {
  std::vector<std::string> names;
  const std::string own = std::to_string(joint);
  if (!evidence.q_m.empty()) {
    names.push_back("q_m" + own);
    for (int j = 1; j <= evidence.joints; ++j)
      if (j != joint) names.push_back("q_m" + std::to_string(j));
  }
  if (!evidence.tau_ext.empty()) names.push_back("tau_ext" + own);
  if (!evidence.dq_m.empty()) names.push_back("direction" + own);
  if (!evidence.tau_ext.empty() && !evidence.dq_m.empty())
    names.push_back("tau_ext" + own + " x direction" + own);
  if (!evidence.dq_m.empty()) names.push_back("dq_m" + own);
  if (!evidence.tau_m.empty()) names.push_back("tau_m" + own);
  return names;
}

std::vector<double> valuesAt(const Evidence& evidence, int joint, std::size_t row, double fastest) {
  std::vector<double> values;
  const auto own = static_cast<std::size_t>(joint - 1);
  if (!evidence.q_m.empty()) {
    values.push_back(evidence.q_m[own][row]);
    for (std::size_t j = 0; j < evidence.q_m.size(); ++j)
      if (j != own) values.push_back(evidence.q_m[j][row]);
  }
  const double direction = evidence.dq_m.empty() ? 0.0 : directionAt(evidence.dq_m[own], row, fastest);
  if (!evidence.tau_ext.empty()) values.push_back(evidence.tau_ext[own][row]);
  if (!evidence.dq_m.empty()) values.push_back(direction);
  if (!evidence.tau_ext.empty() && !evidence.dq_m.empty())
    values.push_back(evidence.tau_ext[own][row] * direction);
  if (!evidence.dq_m.empty()) values.push_back(evidence.dq_m[own][row]);
  if (!evidence.tau_m.empty()) values.push_back(evidence.tau_m[own][row]);
  return values;
}

double fastestOf(const FitData& data, int joint) {
  double fastest = 0.0;
  for (int r = 0; r < data.recordings(); ++r) {
    const Evidence& evidence = data.simulation(r).evidence();
    if (evidence.dq_m.empty()) continue;
    for (const double v : evidence.dq_m[static_cast<std::size_t>(joint - 1)])
      if (std::isfinite(v)) fastest = std::max(fastest, std::abs(v));
  }
  return fastest;
}

/// Takes a constant of its own off the encoder and the columns of each recording. Held-out recordings have
/// theirs, too, as the zeros of their encoders in the models that the regression is compared with.
void centreByRecording(Design& all) {
  const int recordings = all.recording.empty() ? 0 : 1 + std::ranges::max(all.recording);
  for (int r = 0; r < recordings; ++r) {
    std::vector<Index> rows;
    for (Index i = 0; i < all.x.rows(); ++i)
      if (all.recording[static_cast<std::size_t>(i)] == r) rows.push_back(i);
    if (rows.empty()) continue;
    const Eigen::RowVectorXd mean = all.x(rows, Eigen::all).colwise().mean();
    all.x(rows, Eigen::all) = all.x(rows, Eigen::all).rowwise() - mean;
    all.y(rows).array() -= all.y(rows).mean();
  }
}

Design columnsOf(const FitData& data, int joint) {
  const std::vector<Index> samples = samplesOf(data, joint);
  Design all;
  all.names = namesFor(data.simulation(0).evidence(), joint);
  const auto wide = static_cast<Index>(all.names.size());
  const double fastest = fastestOf(data, joint);
  all.x = MatrixXd::Zero(static_cast<Index>(samples.size()), 1 + wide);
  all.y.resize(all.x.rows());
  for (Index i = 0; i < all.x.rows(); ++i) {
    const Index sample = samples[static_cast<std::size_t>(i)];
    const int r = recordingOf(data, sample);
    const Evidence& evidence = data.simulation(r).evidence();
    const double t = data.simulation(r).compared().t[static_cast<std::size_t>(sample - data.first(r))];
    all.x(i, 0) = 1.0;
    all.recording.push_back(r);
    const std::vector<double> values = valuesAt(evidence, joint, rowAt(evidence, t), fastest);
    for (Index k = 0; k < std::min(wide, static_cast<Index>(values.size())); ++k)
      all.x(i, 1 + k) =
          std::isfinite(values[static_cast<std::size_t>(k)]) ? values[static_cast<std::size_t>(k)] : 0.0;
    all.y[i] = data.measured()[sample];
    all.fold.push_back(data.fold(data.block()[static_cast<std::size_t>(sample)]));
  }
  const bool one_each = data.segments().size() > 1;
  if (data.zerosFree() && one_each) centreByRecording(all);
  return all;
}

}  // namespace

double heldOutSquare(const MatrixXd& x, const VectorXd& y, const std::vector<int>& fold) {
  const VectorXd scale =
      x.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min()).cwiseInverse();
  const MatrixXd z = x * scale.asDiagonal();
  double squares = 0.0;
  for (int f = 0; f < kFolds; ++f) {
    std::vector<Index> fitted, tested;
    for (Index i = 0; i < z.rows(); ++i)
      (fold[static_cast<std::size_t>(i)] == f ? tested : fitted).push_back(i);
    if (tested.empty()) continue;
    const MatrixXd a = z(fitted, Eigen::all);
    MatrixXd normal = a.transpose() * a;
    normal.diagonal().array() += 1e-10;
    const VectorXd w = normal.ldlt().solve(a.transpose() * y(fitted));
    squares += (y(tested) - z(tested, Eigen::all) * w).squaredNorm();
  }
  return squares / static_cast<double>(std::max<Index>(1, z.rows()));
}

MeasuredRegression measuredRegression(const FitData& data, int joint) {
  constexpr Index kFewest = 100;
  MeasuredRegression best{std::numeric_limits<double>::quiet_NaN(), {}};
  if (data.rigid()) return best;
  const Design all = columnsOf(data, joint);
  if (all.y.size() < kFewest || all.names.empty()) return best;
  for (Index k = 1; k <= std::min<Index>(kMostColumns - 1, static_cast<Index>(all.names.size())); ++k) {
    const double square = heldOutSquare(all.x.leftCols(1 + k), all.y, all.fold);
    if (best.mean_square <= square) continue;
    best = {square, {all.names.begin(), all.names.begin() + k}};
  }
  return best;
}

}  // namespace capstan::diagnosis
