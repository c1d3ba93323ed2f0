#include "core/recording/source_table.h"

#include <algorithm>
#include <cmath>

#include "core/base/nan.h"

namespace capstan::recording {
namespace {

void pushRow(TableColumns& columns, const Eigen::Vector3d& value) {
  columns.resize(3);
  for (int i = 0; i < 3; ++i) columns[static_cast<std::size_t>(i)].push_back(value(i));
}

void setRow(TableColumns& columns, std::size_t row, const Eigen::Vector3d& value) {
  for (int i = 0; i < 3; ++i) columns[static_cast<std::size_t>(i)][row] = value(i);
}

void dropEmpty(TableColumns& columns) {
  for (const auto& column : columns)
    if (std::any_of(column.begin(), column.end(), [](double x) { return !std::isnan(x); })) return;
  columns.clear();
}

/// Places joints in the first row at or after their time, tips in the last row at or before it.
void place(MeasuredTable& table, const std::vector<tracking::JointSample>& joints,
           const std::vector<tracking::TipSample>& tips) {
  for (const tracking::JointSample& joint : joints) {
    const auto row = std::lower_bound(table.t.begin(), table.t.end(), joint.t);
    if (row != table.t.end())
      setRow(table.q, static_cast<std::size_t>(row - table.t.begin()), joint.position);
  }
  for (const tracking::TipSample& tip : tips) {
    const auto after = std::upper_bound(table.t.begin(), table.t.end(), tip.t);
    if (after != table.t.begin())
      setRow(table.p_c, static_cast<std::size_t>(after - table.t.begin()) - 1, tip.position);
  }
}

}  // namespace

MeasuredTable tableOf(tracking::Source& source, const std::string& file) {
  MeasuredTable table;
  table.file = file;
  table.own_kinematics = source.info().own_kinematics;
  std::vector<tracking::JointSample> joints;
  std::vector<tracking::TipSample> tips;
  tracking::Sample sample;
  while (source.next(sample)) {
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
      if (!table.t.empty() && !(motor->t > table.t.back())) continue;  // sent twice
      table.t.push_back(motor->t);
      pushRow(table.q_m, motor->position);
      pushRow(table.dq_m, motor->velocity);
      pushRow(table.tau_m, motor->torque);
    } else if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) {
      joints.push_back(*joint);
    } else if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) {
      tips.push_back(*tip);
    }
  }
  table.q.assign(3, std::vector<double>(table.rows(), base::kNaN));
  table.p_c = table.q;
  place(table, joints, tips);
  for (TableColumns* columns : {&table.dq_m, &table.tau_m, &table.q, &table.p_c}) dropEmpty(*columns);
  return table;
}

}  // namespace capstan::recording
