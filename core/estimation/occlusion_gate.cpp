#include "core/estimation/occlusion_gate.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cassert>

namespace capstan::estimation {

double chiSquareQuantile(int dof, double probability) {
  assert(dof > 0 && probability > 0.0 && probability < 1.0);
  return boost::math::quantile(boost::math::chi_squared(dof), probability);
}

}  // namespace capstan::estimation
