#include "core/diagnosis/fit/input_noise.h"

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/base/random.h"

namespace capstan::diagnosis {

namespace {

/// RMS change per channel by inputs that `noisy` draws (evidence, inputs, random).
template <class Noisy>
Eigen::VectorXd changeBy(const FitData& data, const Fit& at, const Weighting& weighting, Noisy&& noisy) {
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
  const auto channels = static_cast<Eigen::Index>(data.channels().size());
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(channels), count = Eigen::VectorXd::Zero(channels);
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    squares[data.channel()[i]] += change.row(static_cast<Eigen::Index>(i)).squaredNorm();
    count[data.channel()[i]] += kInputDraws;
  }
  const Eigen::VectorXd rms = squares.cwiseQuotient(count.cwiseMax(1.0)).cwiseSqrt();
  return rms.allFinite() ? rms : Eigen::VectorXd::Zero(channels);
}

}  // namespace

Eigen::VectorXd inputNoise(const FitData& data, const Fit& at, const Weighting& weighting) {
  return changeBy(data, at, weighting, shakenInputs);
}

Eigen::VectorXd torqueNoise(const FitData& data, const Fit& at, const Weighting& weighting) {
  if (!data.rigid()) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.channels().size()));
  return changeBy(data, at, weighting, withTorqueNoise);
}

}  // namespace capstan::diagnosis
