#include "core/identification/drive_recording.h"

#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace capstan::identification {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse(const recording::MeasuredTable& table, const std::string& column,
                         const std::string& value, const std::string& reason, const std::string& remedy) {
  throw base::InputError({table.file, 0, column, value, reason, remedy});
}

void check(const recording::MeasuredTable& table) {
  if (table.joints() > 1)
    refuse(table, "q_m1…" + std::to_string(table.joints()), std::to_string(table.joints()) + " joints",
           "is a recording of more than the one joint of this robot",
           "Leave only the columns q_m1, tau_m1, q1, tau_ext1, or give a robot file of as many joints");
  if (table.q_m.empty())
    refuse(table, "q_m1", {}, "is missing: without motor positions there is no drive to identify",
           "Add the motor encoder [rad] as column q_m1");
  if (table.tau_ext.empty())
    refuse(table, "tau_ext1", {},
           "is missing: without a known load, stiffness and friction cannot be identified",
           "Add the measured load of the joint [N*m or N] as column tau_ext1; zeros for an unloaded joint");
  if (table.q.empty())
    refuse(table, "q1", {}, "is missing: one-joint identification compares with a joint encoder",
           "Add the joint encoder [rad or m] as column q1");
}

/// Slope of the straight line through x(t) within `half` seconds of row i; 0 where there is none.
double slopeAt(const std::vector<double>& t, const std::vector<double>& x, std::size_t i, double half) {
  double n = 0.0, st = 0.0, sx = 0.0, stt = 0.0, stx = 0.0;
  const auto add = [&](std::size_t k) {
    if (std::isnan(x[k])) return;
    const double dt = t[k] - t[i], dx = x[k] - x[i];
    n += 1.0, st += dt, sx += dx, stt += dt * dt, stx += dt * dx;
  };
  for (std::size_t k = i + 1; k-- > 0 && t[i] - t[k] <= half;) add(k);
  for (std::size_t k = i + 1; k < t.size() && t[k] - t[i] <= half; ++k) add(k);
  const double spread = n * stt - st * st;
  return spread > 0.0 ? (n * stx - st * sx) / spread : 0.0;
}

double cellOf(const recording::TableColumns& columns, std::size_t row) {
  return columns.empty() ? kNone : columns.front()[row];
}

}  // namespace

DriveRecording driveRecording(const recording::MeasuredTable& table, double step) {
  check(table);
  DriveRecording recording;
  recording.title = table.file;
  constexpr double kSlack = 1e-9;  // rounding error of the time of a row [s]
  double due = -std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.t[row], q_m = table.q_m.front()[row], load = table.tau_ext.front()[row];
    if (t < due - kSlack || std::isnan(q_m) || std::isnan(load)) continue;
    due = t + step;
    const double given = cellOf(table.dq_m, row);
    recording.t.push_back(t);
    recording.q_m.push_back(q_m);
    recording.dq_m.push_back(std::isnan(given) ? slopeAt(table.t, table.q_m.front(), row, step) : given);
    recording.tau_m.push_back(cellOf(table.tau_m, row));
    recording.tau_ext.push_back(load);
    recording.q.push_back(cellOf(table.q, row));
  }
  if (recording.size() < 2)
    refuse(table, "q_m1", {}, "and tau_ext1 have less than two rows with both", "Give a longer recording");
  return recording;
}

double torqueSign(const std::vector<DriveRecording>& recordings) {
  double work = 0.0;
  for (const DriveRecording& recording : recordings)
    for (std::size_t k = 1; k < recording.size(); ++k) {
      const double torque = 0.5 * (recording.tau_m[k] + recording.tau_m[k - 1]);
      if (!std::isnan(torque)) work += torque * (recording.q_m[k] - recording.q_m[k - 1]);
    }
  return work < 0.0 ? -1.0 : 1.0;
}

}  // namespace capstan::identification
