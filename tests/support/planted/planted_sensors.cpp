#include "tests/support/planted/planted_sensors.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace capstan::test {
namespace {

using Eigen::Vector3d;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

Joints jointsAt(const PlantedMotion& motion, double row) {
  if (row <= 0.0) return motion.q.front();
  const auto k = static_cast<std::size_t>(row);
  const double share = row - static_cast<double>(k);
  if (share == 0.0 || k + 1 >= motion.q.size()) return motion.q[std::min(k, motion.q.size() - 1)];
  Joints q{};
  for (int i = 0; i < kMostJoints; ++i) q[i] = (1.0 - share) * motion.q[k][i] + share * motion.q[k + 1][i];
  return q;
}

/// The registration that the cameras assume.
Vector3d misregistered(const Vector3d& point, const std::vector<Planted>& effects) {
  Vector3d p = point;
  for (const Planted& e : effects) {
    if (e.magnitude == 0.0) continue;
    if (e.effect == Effect::kCameraRotation) p = Eigen::AngleAxisd(e.magnitude, e.axis) * p;
    if (e.effect == Effect::kCameraScale) p *= 1.0 + e.magnitude;
    if (e.effect == Effect::kCameraOffset) p += e.magnitude * e.axis;
  }
  return p;
}

recording::TableColumns columns(int n, std::size_t rows, double value = 0.0) {
  return recording::TableColumns(static_cast<std::size_t>(n), std::vector<double>(rows, value));
}

void copyJoints(const std::vector<Joints>& from, recording::TableColumns& to) {
  for (std::size_t i = 0; i < to.size(); ++i)
    for (std::size_t k = 0; k < from.size(); ++k) to[i][k] = from[k][i];
}

void senseLoads(const PlantedMotion& motion, const std::vector<Planted>& effects, double sigma,
                recording::TableColumns& to, base::Random& random) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    const bool magnitude_only = tellsNoSign(effects, static_cast<int>(i));
    for (std::size_t k = 0; k < motion.load.size(); ++k) {
      const double load = motion.load[k][i] + random.normal(0.0, sigma);
      to[i][k] = magnitude_only ? std::abs(load) : load;
    }
  }
}

void senseTip(const PlantedMotion& motion, const robot::Description& nominal,
              const std::vector<Planted>& effects, const SensorOptions& options, recording::TableColumns& to,
              base::Random& random) {
  RigidChain chain(nominal);
  const auto frames = exposures(motion, options, random);
  Vector3d middle = Vector3d::Zero();
  for (const std::size_t k : frames)
    middle += cameraTip(motion, k, chain, nominal.marker, {}) / static_cast<double>(frames.size());
  const StereoPair cameras(middle, options);
  for (const std::size_t k : frames) {
    std::vector<Planted> latency;
    for (const Planted& e : effects)
      if (e.effect == Effect::kCameraLatency) latency.push_back(e);
    const Vector3d seen = cameras.see(cameraTip(motion, k, chain, nominal.marker, latency), random);
    const Vector3d told = misregistered(seen, effects);
    for (int axis = 0; axis < 3; ++axis) to[static_cast<std::size_t>(axis)][k] = told(axis);
  }
}

void thin(std::vector<double>& column, std::size_t period) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < column.size(); k += period) column[kept++] = column[k];
  column.resize(kept);
}

/// Keeps every `period`th row.
void thin(recording::MeasuredTable& table, std::size_t period) {
  thin(table.t, period);
  for (recording::TableColumns* columns :
       {&table.q_m, &table.dq_m, &table.tau_m, &table.q, &table.p_c, &table.tau_ext})
    for (auto& column : *columns) thin(column, period);
}

}  // namespace

StereoPair::StereoPair(const Vector3d& looks_at, const SensorOptions& options) : options_(options) {
  const Vector3d back = Vector3d(0.35, -0.45, 0.82).normalized();
  position_ = looks_at + options.distance * back;
  const Vector3d forward = -back, right = Vector3d::UnitY().cross(forward).normalized();
  base_from_camera_ << right, forward.cross(right), forward;
}

Vector3d StereoPair::see(const Vector3d& point, base::Random& random) const {
  const Vector3d p = base_from_camera_.transpose() * (point - position_);
  const double f = options_.focal_length, b = options_.baseline, sigma = options_.pixel_sigma;
  const double left = f * p.x() / p.z() + random.normal(0.0, sigma);
  const double right = f * (p.x() - b) / p.z() + random.normal(0.0, sigma);
  const double row_left = f * p.y() / p.z() + random.normal(0.0, sigma);
  const double row_right = f * p.y() / p.z() + random.normal(0.0, sigma);
  const double z = f * b / (left - right);
  const Vector3d seen(0.5 * ((left + right) * z / f + b), 0.5 * (row_left + row_right) * z / f, z);
  return position_ + base_from_camera_ * seen;
}

double StereoPair::sigma() const {
  const double across = options_.distance / options_.focal_length * options_.pixel_sigma / std::sqrt(2.0);
  const double along = options_.distance * options_.distance / (options_.focal_length * options_.baseline) *
                       std::sqrt(2.0) * options_.pixel_sigma;
  return std::sqrt(2.0 * across * across + along * along);
}

std::vector<std::size_t> exposures(const PlantedMotion& motion, const SensorOptions& options,
                                   base::Random& random) {
  std::vector<std::size_t> rows;
  const double rate = 1e3, first = random.uniform(0.0, 1.0 / options.frame_rate);
  const double last = motion.t.back() - options.frame_delay;
  for (int frame = 0;; ++frame) {
    const double t = first + frame / options.frame_rate;
    const auto period = static_cast<std::size_t>(options.row_period);
    const auto row = period * static_cast<std::size_t>(std::lround(t * rate / options.row_period));
    if (t > last || row >= motion.t.size()) return rows;
    rows.push_back(row);
  }
}

Vector3d cameraTip(const PlantedMotion& motion, std::size_t k, RigidChain& chain, const Vector3d& marker,
                   const std::vector<Planted>& effects) {
  double late = 0.0;
  for (const Planted& e : effects)
    if (e.effect == Effect::kCameraLatency) late += e.magnitude;
  chain.pose(jointsAt(motion, static_cast<double>(k) - 1e3 * late));
  return misregistered(chain.point(marker), effects);
}

double jointReading(const PlantedMotion& motion, std::size_t k, int i, const std::vector<Planted>& effects) {
  double reading = motion.q[k][i];
  for (const Planted& e : effects)
    if (e.effect == Effect::kEncoderDrift && e.joint == i) reading += e.magnitude * motion.t[k];
  return reading;
}

recording::MeasuredTable sense(const PlantedMotion& motion, const robot::Description& nominal,
                               const std::vector<Planted>& effects, const SensorOptions& options,
                               base::Random& random) {
  const int n = nominal.size();
  const std::size_t rows = motion.t.size();
  recording::MeasuredTable table;
  table.file = "recording";
  table.t = motion.t;
  if (options.motor_encoders) copyJoints(motion.motor_reading, table.q_m = columns(n, rows));
  if (options.motor_velocity) copyJoints(motion.motor_rate_reading, table.dq_m = columns(n, rows));
  if (options.motor_torque) copyJoints(motion.torque, table.tau_m = columns(n, rows));
  if (options.joint_encoders) {
    table.q = columns(n, rows);
    for (int i = 0; i < n; ++i) {
      const bool turns = nominal.joints[static_cast<std::size_t>(i)].type == robot::JointType::kRevolute;
      const double count = turns ? options.turn_count : options.slide_count;
      for (std::size_t k = 0; k < rows; ++k)
        table.q[static_cast<std::size_t>(i)][k] =
            count * std::round(jointReading(motion, k, i, effects) / count);
    }
  }
  if (options.cameras)
    senseTip(motion, nominal, effects, options, table.p_c = columns(3, rows, kNothing), random);
  if (options.load_cells)
    senseLoads(motion, effects, options.load_sigma, table.tau_ext = columns(n, rows), random);
  if (options.row_period > 1) thin(table, static_cast<std::size_t>(options.row_period));
  return table;
}

}  // namespace capstan::test
