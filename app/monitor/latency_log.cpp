#include "app/monitor/latency_log.h"

#include <algorithm>
#include <span>

#include "core/stats/quantile.h"

namespace capstan::monitor {

void LatencyLog::add(double seconds) { values_[count_++ % kKept] = seconds; }

LatencyLog::Summary LatencyLog::summary() const {
  if (count_ == 0) return {};
  const std::span kept(values_.data(), std::min(count_, kKept));
  const auto at = stats::quantiles(kept, std::array{0.5, 0.99, 1.0});
  return {count_, at[0], at[1], at[2]};
}

}  // namespace capstan::monitor
