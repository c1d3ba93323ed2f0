#include "core/analysis/analysis_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace capstan::analysis {
namespace {

constexpr double kSame = 2e-6;        ///< largest difference of equal times, which are rounded to 1e-6 s [s]
constexpr double kGap = 3.0;          ///< shortest gap, in spacings
constexpr double kPairedShare = 0.8;  ///< smallest share of the shorter side that has partners
constexpr double kLeastSpacing = 1e-9;  ///< smallest spacing [s]

/// Errors of `a` and of `b` at their common times.
std::pair<SelectedErrors, SelectedErrors> commonInstants(const SelectedErrors& a, const SelectedErrors& b) {
  std::pair<SelectedErrors, SelectedErrors> common;
  for (std::size_t i = 0, j = 0; i < a.t.size() && j < b.t.size();) {
    if (std::abs(a.t[i] - b.t[j]) < kSame) {
      common.first.t.push_back(a.t[i]);
      common.second.t.push_back(a.t[i]);
      common.first.value.push_back(a.value[i++]);
      common.second.value.push_back(b.value[j++]);
    } else if (a.t[i] < b.t[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return common;
}

/// Spacing of steps that keeps at most kMostResampled samples of either side.
double spacingFor(const SelectedErrors& a, const SelectedErrors& b, double spacing) {
  const std::size_t most = std::max(spaced(a, spacing).value.size(), spaced(b, spacing).value.size());
  return spacing * static_cast<double>((most + kMostResampled - 1) / kMostResampled);
}

}  // namespace

double spacingOf(const std::vector<double>& t) {
  if (t.size() < 2) return 0.0;
  std::vector<double> steps(t.size() - 1);
  for (std::size_t i = 0; i + 1 < t.size(); ++i) steps[i] = t[i + 1] - t[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

SpacedErrors spaced(const SelectedErrors& errors, double spacing) {
  const double own = std::max(spacingOf(errors.t), kLeastSpacing);
  SpacedErrors kept;
  double due = 0.0;
  for (std::size_t i = 0; i < errors.t.size(); ++i) {
    const bool begins = i == 0 || errors.t[i] - errors.t[i - 1] > kGap * own;
    if (!begins && errors.t[i] < due - 0.5 * own) continue;
    if (begins) {
      kept.pieces.push_back(0);
      due = errors.t[i];
    }
    kept.value.push_back(errors.value[i]);
    ++kept.pieces.back();
    due = std::max(due + spacing, errors.t[i]);
  }
  return kept;
}

Sides sidesOf(const AnalysisRow& row, const ErrorRun& a, const ErrorRun* b, const AnalysisOptions& options,
              bool same_motion) {
  const experiments::Estimator before = b ? row.estimator : experiments::Estimator::kKinematic;
  SelectedErrors first = selectedErrors(a, before, row.joint, options);
  SelectedErrors second = selectedErrors(b ? *b : a, row.estimator, row.joint, options);
  Sides sides;
  if (!b || same_motion) {
    auto common = commonInstants(first, second);
    const auto shorter = static_cast<double>(std::min(first.t.size(), second.t.size()));
    sides.paired = static_cast<double>(common.first.t.size()) >= kPairedShare * shorter;
    if (sides.paired) {
      sides.common = common.first.t.size();
      std::tie(first, second) = std::move(common);
    }
  }
  const double spacing =
      spacingFor(first, second, std::max({spacingOf(first.t), spacingOf(second.t), kLeastSpacing}));
  sides.first = spaced(first, spacing);
  sides.second = spaced(second, spacing);
  return sides;
}

}  // namespace capstan::analysis
