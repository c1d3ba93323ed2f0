#include "core/base/yaml.h"
#include "core/identification/options.h"
#include "core/simulation/trajectory.h"
#include "core/tracking/options.h"
#include "core/vision/registration_file.h"
#include "tests/fuzz/fuzz_target.h"

/// Files of options: each text is read as each kind of them.
CAPSTAN_FUZZ_TARGET(option_files) {
  using namespace capstan;
  const std::string text(bytes);
  fuzz::allowInputError([&] { base::readYaml<tracking::TrackingOptions>(text, "tracking.yaml"); });
  fuzz::allowInputError(
      [&] { base::readYaml<identification::IdentificationOptions>(text, "identification.yaml"); });
  fuzz::allowInputError([&] { base::readYaml<simulation::TrajectorySpec>(text, "trajectory.yaml"); });
  fuzz::allowInputError([&] {
    const auto pose = vision::readRegistration(fuzz::fileOf(bytes, "registration.yaml"));
    fuzz::require((pose.linear() * pose.linear().transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-5,
                  "a registration has a rotation");
  });
}
