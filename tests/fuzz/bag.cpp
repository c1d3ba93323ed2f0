#include <cmath>

#include "core/robot/description.h"
#include "core/ros1/bag_source.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(bag) {
  using namespace capstan;
  static const robot::Description robot = robot::defaultDescription();
  fuzz::allowInputError([&] {
    const auto source = ros1::openBag(fuzz::fileOf(bytes, "trial.bag"), robot);
    tracking::Sample sample;
    while (source->next(sample)) {
      const double t = std::visit([](const auto& one) { return one.t; }, sample);
      fuzz::require(std::isfinite(t), "times are finite");
    }
  });
}
