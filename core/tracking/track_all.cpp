#include "core/tracking/track_all.h"

#include <cmath>
#include <limits>

namespace capstan::tracking {
namespace {

double ratio(double part, std::uint64_t whole) {
  return whole == 0 ? std::numeric_limits<double>::quiet_NaN() : part / static_cast<double>(whole);
}

}  // namespace

void TrackReport::add(const Snapshot& snapshot) {
  errors.add(snapshot);
  transmission = snapshot.transmission;
  own_kinematics = snapshot.own_kinematics;
  if (snapshot.motor_updated && motor_samples++ == 0) first_t = snapshot.t;
  if (motor_samples > 0) last_t = snapshot.t;
  for (std::size_t i = 0; i < 3; ++i) {
    if (snapshot.motor_failed[i] == motor_failed[i]) continue;
    motor_failed[i] = snapshot.motor_failed[i];
    motor_failed_since[i] = snapshot.t;
  }
  rescues += rescue_rise_.to(snapshot.rescues);
  late_dropped += late_rise_.to(snapshot.late_dropped);
  motor_refused += refused_rise_.to(snapshot.motor_refused);
  motor_stray += stray_rise_.to(snapshot.motor_stray);
  if (snapshot.reference_paired && std::isfinite(snapshot.nees)) {
    nees_sum += snapshot.nees;
    ++nees_count;
  }
  if (!snapshot.camera_updated) return;
  ++camera_samples;
  ++gates[static_cast<std::size_t>(snapshot.gate)];
  latencies.add(snapshot.latency);
  innovations.add(snapshot.t_cam, snapshot.innovation, snapshot.innovation_sigma);
  if (snapshot.gate == Gate::kOpen) nis_sum += snapshot.nis;
  if (snapshot.ray_used) {
    ++rays;
    ray_nis_sum += snapshot.ray_nis;
  }
  if (!snapshot.camera_images) return;
  ++frames;
  for (std::size_t side = 0; side < 2; ++side) {
    if (snapshot.view_blocked[side]) ++blocked[side];
    if (snapshot.marker[side].fault == vision::MarkerFault::kWrongImage) ++wrong_image[side];
    if (snapshot.view_blocked[side] || !snapshot.marker[side].found()) continue;
    ++detected[side];
    if (snapshot.marker[side].full_frame) ++full_frame[side];
  }
}

void TrackReport::restart(ReportStart start) {
  const ReportStart kept = motor_samples > 0 ? start : since;
  *this = {};
  since = kept;
}

double TrackReport::gateShare(Gate gate) const {
  return ratio(static_cast<double>(gates[static_cast<std::size_t>(gate)]), camera_samples);
}

std::uint64_t TrackReport::unblocked(int side) const {
  return frames - blocked[static_cast<std::size_t>(side)];
}

double TrackReport::detectionRate(int side) const {
  return ratio(static_cast<double>(detected[static_cast<std::size_t>(side)]), unblocked(side));
}

double TrackReport::nisMean() const {
  return ratio(nis_sum / 3.0, gates[static_cast<std::size_t>(Gate::kOpen)]);
}

double TrackReport::rayNisMean() const { return ratio(ray_nis_sum / 2.0, rays); }

double TrackReport::neesMean() const { return ratio(nees_sum / 3.0, nees_count); }

}  // namespace capstan::tracking
