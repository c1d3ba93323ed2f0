#include "core/diagnosis/fit/free_system.h"

#include "core/diagnosis/fit/linear_system.h"

namespace capstan::diagnosis {

using Eigen::Index;

namespace {

/// True for the time of a single event, which one block alone determines.
bool isEvent(const FitParameter& parameter) { return parameter.name.ends_with(".time"); }

}  // namespace

FreeSystem::FreeSystem(const FitData& data, const Fit& fit, const Weighting& weighting, bool hold_events) {
  for (Index k = 0; k < fit.u.size(); ++k) {
    const bool held = !fit.bound.empty() && fit.bound[static_cast<std::size_t>(k)];
    if (!held && !(hold_events && isEvent(fit.model.parameters()[static_cast<std::size_t>(k)])))
      free.push_back(k);
  }
  jacobian = weighting.weights.asDiagonal() * fit.jacobian(Eigen::all, free);
  e = weighting.weights.cwiseProduct(fit.e);
  normal = jacobian.transpose() * jacobian;
  normal.diagonal() += priorPrecision(fit.model)(free);
  rows.resize(static_cast<std::size_t>(data.blocks()));
  for (std::size_t i = 0; i < data.block().size(); ++i)
    rows[static_cast<std::size_t>(data.block()[i])].push_back(static_cast<Index>(i));
}

}  // namespace capstan::diagnosis
