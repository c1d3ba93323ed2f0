#include "core/stats/chi_square.h"

#include <boost/math/distributions/chi_squared.hpp>

#include "core/base/check.h"

namespace capstan::stats {

double chiSquareQuantile(int dof, double probability) {
  CAPSTAN_CHECK(dof > 0 && probability > 0.0 && probability < 1.0);
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

}  // namespace capstan::stats
