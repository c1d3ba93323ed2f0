#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "core/base/parallel.h"
#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

FitData::FitData(const std::vector<Evidence>& recordings, const robot::Description& robot, double horizon,
                 EncoderZeros zeros, int threads, const base::Progress* progress)
    : threads_(threads), progress_(progress), zeros_(zeros) {
  if (zeros_ == EncoderZeros::kOnePerRecording && recordings.size() == 1) zeros_ = EncoderZeros::kKnown;
  for (const Evidence& evidence : recordings) {
    rigid_ = evidence.drive == DriveKind::kRigid;
    simulations_.push_back(std::make_unique<ChainSimulation>(evidence, robot, horizon));
    stack(*simulations_.back());
  }
  if (!rigid_ && zeros_ == EncoderZeros::kOneForAll) segments_.emplace_back(0, measured_.size());
}

void FitData::stack(const ChainSimulation& simulation) {
  const Compared& compared = simulation.compared();
  const Eigen::Index begin = measured_.size();
  first_.push_back(begin);
  measured_.conservativeResize(begin + compared.measured.size());
  measured_.tail(compared.measured.size()) = compared.measured;
  const int first_channel = static_cast<int>(channels_.size());
  for (const ComparedChannel& channel : compared.channels) addChannel(channel);
  for (const int channel : compared.channel) channel_.push_back(first_channel + channel);
  const bool windows_have_own = rigid_;
  for (std::size_t w = 0; w + 1 < compared.window_begin.size(); ++w) {
    const std::size_t from = compared.window_begin[w], to = compared.window_begin[w + 1];
    if (from == to) continue;
    if (windows_have_own)
      segments_.emplace_back(begin + static_cast<Eigen::Index>(from), begin + static_cast<Eigen::Index>(to));
    const auto [low, high] = std::minmax_element(compared.t.begin() + static_cast<std::ptrdiff_t>(from),
                                                 compared.t.begin() + static_cast<std::ptrdiff_t>(to));
    const double span = *high - *low;
    const bool whole = rigid_ && span < 4.0 * kBlock;
    const int pieces = whole ? 1 : std::max(1, static_cast<int>(std::lround(span / kBlock)));
    for (std::size_t i = from; i < to; ++i) {
      const double share = span > 0.0 ? (compared.t[i] - *low) / span : 0.0;
      block_.push_back(blocks_ + std::min(pieces - 1, static_cast<int>(share * pieces)));
    }
    blocks_ += pieces;
    recording_of_.resize(static_cast<std::size_t>(blocks_), recordings() - 1);
  }
  if (!windows_have_own && zeros_ == EncoderZeros::kOnePerRecording)
    segments_.emplace_back(begin, measured_.size());
}

int FitData::folds() const { return std::min(kFolds, recordings() >= kWholeFolds ? recordings() : blocks_); }

int FitData::fold(int block) const {
  const bool whole = recordings() >= kWholeFolds;
  return (whole ? recording_of_[static_cast<std::size_t>(block)] : block) % folds();
}

void FitData::addChannel(const ComparedChannel& channel) {
  int sensor = sensors_;
  for (std::size_t c = 0; c < channels_.size(); ++c)
    if (channels_[c].joint == channel.joint && channels_[c].axis == channel.axis) sensor = sensor_of_[c];
  sensors_ = std::max(sensors_, sensor + 1);
  sensor_of_.push_back(sensor);
  channels_.push_back(channel);
}

namespace {

/// Robots of one recording that are simulated side by side, at most 16.
struct Group {
  std::size_t recording = 0;
  int steps = 1;
  std::vector<std::size_t> members;
};

/// Bits of the joints that are compliant. At each joint all or none of a group are, since no parameter value
/// turns that law off.
unsigned complianceOf(const robot::ChainModel& model) {
  unsigned bits = 0;
  for (int j = 0; j < model.shape.joints; ++j)
    if (model.shape.laws[j] & robot::kLawCompliance) bits |= 1u << j;
  return bits;
}

/// Groups of one recording: of equal compliance and equal numbers of integration steps.
void addGroups(const ChainSimulation& simulation, std::size_t recording,
               const std::vector<robot::ChainModel>& models, const std::vector<std::size_t>& family,
               std::vector<Group>& groups) {
  std::map<std::size_t, int> steps;  // of each family
  for (std::size_t k = 0; k < models.size(); ++k) {
    int& most = steps[family.empty() ? 0 : family[k]];
    most = std::max(most, simulation.stepsFor(models[k]));
  }
  std::map<std::pair<unsigned, int>, std::vector<std::size_t>> kinds;
  for (std::size_t k = 0; k < models.size(); ++k)
    kinds[{complianceOf(models[k]), steps[family.empty() ? 0 : family[k]]}].push_back(k);
  for (const auto& [kind, members] : kinds)
    for (std::size_t k = 0; k < members.size(); ++k) {
      if (k % robot::kChainLanes == 0) groups.push_back({recording, kind.second, {}});
      groups.back().members.push_back(members[k]);
    }
}

/// Work of the simulation of one robot with this many steps per row: integration steps × joints, and for
/// rigid drives, whose joints move each other, × joints again.
double workOf(const ChainSimulation& simulation, int steps) {
  std::size_t rows = 0;
  for (const Window& window : simulation.windows()) rows += window.end - window.begin;
  const double joints = simulation.evidence().joints;
  const double each = simulation.evidence().drive == DriveKind::kRigid ? joints * joints : joints;
  return static_cast<double>(rows) * steps * each;
}

}  // namespace

Eigen::MatrixXd FitData::simulate(const std::vector<robot::ChainModel>& models,
                                  const std::vector<InitialStates>& initial,
                                  const std::vector<std::size_t>& family) const {
  Eigen::MatrixXd readings(size(), static_cast<Eigen::Index>(models.size()));
  std::vector<Group> groups;
  for (std::size_t r = 0; r < simulations_.size(); ++r)
    addGroups(*simulations_[r], r, models, family, groups);
  double done = work_;
  std::mutex mutex;
  const auto workOfGroup = [&](const Group& group) {
    return static_cast<double>(group.members.size()) * workOf(*simulations_[group.recording], group.steps);
  };
  for (const Group& group : groups) work_ += workOfGroup(group);
  base::parallelFor(groups.size(), threads_, [&](std::size_t task) {
    const auto& [r, steps, members] = groups[task];
    std::vector<Robot> robots;
    for (const std::size_t k : members)
      robots.push_back({&models[k], initial.empty() ? nullptr : &initial[k][r], steps});
    const Eigen::Index rows = simulations_[r]->compared().measured.size();
    Eigen::MatrixXd columns(rows, static_cast<Eigen::Index>(members.size()));
    simulations_[r]->simulate(robots, columns);
    for (std::size_t k = 0; k < members.size(); ++k)
      readings.col(static_cast<Eigen::Index>(members[k])).segment(first_[r], rows) =
          columns.col(static_cast<Eigen::Index>(k));
    if (!on_work_) return;
    const std::lock_guard lock(mutex);
    on_work_(done += workOfGroup(groups[task]));
  });
  return readings;
}

namespace {

/// Sums over the readings of one sensor.
struct SensorSums {
  double squares = 0.0, count = 0.0, noise = 0.0;
  double blocks = 0.0;  ///< Σ (Σ e of a block)²

  double rms() const { return count > 0.0 ? std::sqrt(squares / count) : 0.0; }
  /// Correlation length in samples, from the variance of the blocks' sums.
  double inflation() const {
    return squares > 0.0 ? std::clamp(blocks / squares, 1.0, count / 10.0 + 1.0) : 1.0;
  }
};

std::vector<SensorSums> sumsOf(const FitData& data, const Eigen::VectorXd& e) {
  constexpr double kLeastNoise = 1e-12;
  std::vector<SensorSums> sums(static_cast<std::size_t>(data.sensors()));
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(data.sensors(), data.blocks());
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const int sensor = data.sensorOf()[static_cast<std::size_t>(data.channel()[i])];
    const double x = e[static_cast<Eigen::Index>(i)];
    SensorSums& own = sums[static_cast<std::size_t>(sensor)];
    own.squares += x * x, own.count += 1.0;
    blocks(sensor, data.block()[i]) += x;
  }
  for (std::size_t s = 0; s < sums.size(); ++s)
    sums[s].blocks = blocks.row(static_cast<Eigen::Index>(s)).squaredNorm();
  for (std::size_t c = 0; c < data.channels().size(); ++c) {
    SensorSums& own = sums[static_cast<std::size_t>(data.sensorOf()[c])];
    own.noise = std::max({own.noise, data.channels()[c].noise, kLeastNoise});
  }
  return sums;
}

/// Largest ratio RMS / noise of all sensors, at least 1.
double worstRatio(const std::vector<SensorSums>& sums) {
  double worst = 1.0;
  for (const SensorSums& sensor : sums)
    if (sensor.count > 0.0) worst = std::max(worst, sensor.rms() / sensor.noise);
  return worst;
}

/// Weight of each reading, from a scale per sensor.
Eigen::VectorXd weightsOf(const FitData& data, const std::vector<SensorSums>& sums,
                          const std::vector<double>& scale) {
  Eigen::VectorXd weights(data.size());
  for (std::size_t i = 0; i < data.channel().size(); ++i) {
    const auto sensor =
        static_cast<std::size_t>(data.sensorOf()[static_cast<std::size_t>(data.channel()[i])]);
    weights[static_cast<Eigen::Index>(i)] = 1.0 / (scale[sensor] * std::sqrt(sums[sensor].inflation()));
  }
  return weights;
}

}  // namespace

Eigen::VectorXd weightsFor(const FitData& data, const Eigen::VectorXd& e) {
  const std::vector<SensorSums> sums = sumsOf(data, e);
  const double worst = worstRatio(sums);
  std::vector<double> scale;
  for (const SensorSums& sensor : sums)
    scale.push_back(std::max(sensor.rms(), sensor.noise * std::sqrt(worst)));
  return weightsOf(data, sums, scale);
}

Eigen::VectorXd noiseWeightsFor(const FitData& data, const Eigen::VectorXd& e) {
  const std::vector<SensorSums> sums = sumsOf(data, e);
  const double worst = worstRatio(sums);
  std::vector<double> scale;
  for (const SensorSums& sensor : sums) scale.push_back(sensor.noise * std::sqrt(worst));
  return weightsOf(data, sums, scale);
}

}  // namespace capstan::diagnosis
