#include "core/estimation/consistency.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/check.h"

namespace capstan::estimation {

Band chiSquareBand(int dof, std::int64_t count, double confidence) {
  CAPSTAN_CHECK(dof > 0 && count > 0 && confidence > 0.0 && confidence < 1.0);
  const double all = static_cast<double>(dof) * static_cast<double>(count);
  const boost::math::chi_squared distribution(all);
  const double tail = 0.5 * (1.0 - confidence);
  return {boost::math::quantile(distribution, tail) / all,
          boost::math::quantile(boost::math::complement(distribution, tail)) / all};
}

ConsistencyWindow::ConsistencyWindow(int dof, int window, double confidence) : dof_(dof) {
  CAPSTAN_CHECK(dof > 0 && window > 0);
  values_.resize(static_cast<std::size_t>(window));
  bands_.reserve(values_.size());
  for (int count = 1; count <= window; ++count) bands_.push_back(chiSquareBand(dof, count, confidence));
}

void ConsistencyWindow::reset() {
  count_ = 0;
  next_ = 0;
  sum_ = 0.0;
}

void ConsistencyWindow::add(double value) {
  if (!std::isfinite(value)) return;
  const int window = static_cast<int>(values_.size());
  double& slot = values_[static_cast<std::size_t>(next_)];
  if (count_ == window)
    sum_ -= slot;
  else
    ++count_;
  slot = value;
  sum_ += value;
  next_ = (next_ + 1) % window;
  if (next_ == 0) sum_ = std::accumulate(values_.begin(), values_.begin() + count_, 0.0);
}

double ConsistencyWindow::mean() const {
  return count_ == 0 ? std::numeric_limits<double>::quiet_NaN() : sum_ / (static_cast<double>(count_) * dof_);
}

Band ConsistencyWindow::band() const {
  return count_ == 0 ? Band{0.0, std::numeric_limits<double>::infinity()}
                     : bands_[static_cast<std::size_t>(count_ - 1)];
}

}  // namespace capstan::estimation
