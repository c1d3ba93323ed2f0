#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/resource.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {

inline robot::Description raven() {
  return robot::readDescription(base::resource("robots/raven2_left.yaml"));
}

/// A short recording of the RAVEN-II, drifted but without texture, with or without an effect.
struct Planted {
  robot::Description robot = raven();
  test::Truth truth;
  std::vector<Evidence> evidence;

  explicit Planted(std::uint64_t seed, std::optional<test::Effect> effect = {}, int joint = 0,
                   double duration = 12.0) {
    test::DrawOptions options;
    options.robot = robot;
    options.effects = effect ? 1 : 0;
    if (effect) options.effect = effect;
    if (effect && joint > 0) options.joint = joint;
    options.size = 0.6;
    options.textured = false;
    options.duration = duration;
    auto [recording, measured] = test::recordWithTruth(test::draw(seed, options));
    truth = measured;
    evidence.push_back(evidenceOf(recording.table, robot));
  }
};

}  // namespace capstan::diagnosis
