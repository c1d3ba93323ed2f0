#include "core/diagnosis/fit/input_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/random.h"

namespace capstan::diagnosis {

namespace {

/// Changes in the readings, one column per draw.
InputNoise noiseFrom(const FitData& data, const Eigen::MatrixXd& change) {
  const auto channels = static_cast<Eigen::Index>(data.channels().size());
  InputNoise noise = noInputNoise(channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(data.blocks(), change.cols());
    double count = 0.0;
    for (std::size_t i = 0; i < data.channel().size(); ++i) {
      if (data.channel()[i] != c) continue;
      squares.row(data.block()[i]) += change.row(static_cast<Eigen::Index>(i)).cwiseAbs2();
      count += 1.0;
    }
    const Eigen::VectorXd mean = squares.rowwise().mean();
    const double sum = mean.sum();
    const double variance = (squares.colwise() - mean).squaredNorm() / (change.cols() - 1.0);
    if (!(sum > 0.0) || !std::isfinite(sum)) continue;
    noise.rms[c] = std::sqrt(sum / count);
    noise.correlation[c] = std::max(1.0, 0.5 * count * variance / (sum * sum));
  }
  return noise;
}

/// Changes by inputs that `noisy` draws (evidence, inputs, random).
template <class Noisy>
InputNoise changeBy(const FitData& data, const Fit& at, const Weighting& weighting, Noisy&& noisy) {
  const robot::ChainModel robot = at.model.chain(at.u);
  Eigen::MatrixXd change(data.size(), kInputDraws);
  base::parallelFor(kInputDraws, data.threads(), [&](std::size_t draw) {
    for (int r = 0; r < data.recordings(); ++r) {
      const ChainSimulation& simulation = data.simulation(r);
      base::Random random(static_cast<std::uint64_t>(draw), fmt::format("input noise of recording {}", r));
      Eigen::MatrixXd shaken(simulation.compared().measured.size(), 1);
      simulation.simulateWith(noisy(simulation.evidence(), simulation.inputs(), random),
                              {&robot, &at.initial[static_cast<std::size_t>(r)]}, shaken);
      change.col(static_cast<Eigen::Index>(draw)).segment(data.first(r), shaken.rows()) = shaken;
    }
  });
  change.colwise() -= data.simulate({robot}, {at.initial}).col(0);
  takeOffNuisances(data, at, weighting, change);
  return noiseFrom(data, change);
}

}  // namespace

InputNoise noInputNoise(Eigen::Index channels) {
  return {Eigen::VectorXd::Zero(channels), Eigen::VectorXd::Ones(channels)};
}

InputNoise inputNoise(const FitData& data, const Fit& at, const Weighting& weighting) {
  return changeBy(data, at, weighting, shakenInputs);
}

InputNoise torqueNoise(const FitData& data, const Fit& at, const Weighting& weighting) {
  if (!data.rigid()) return noInputNoise(static_cast<Eigen::Index>(data.channels().size()));
  return changeBy(data, at, weighting, withTorqueNoise);
}

}  // namespace capstan::diagnosis
