#include <cmath>

#include "core/base/resource.h"
#include "core/registration/pair_table.h"
#include "core/vision/rig_file.h"
#include "tests/fuzz/fuzz_target.h"

/// A table of pairs; behind "====", a second one with the poses.
CAPSTAN_FUZZ_TARGET(pair_table) {
  using namespace capstan;
  static const vision::StereoRig rig = vision::readRig(base::resource("cameras/left.yaml").parent_path());
  static const std::optional<vision::Triangulator> triangulator{rig};
  const auto parts = fuzz::partsOf(bytes, 2);
  fuzz::allowInputError([&] {
    const registration::NamedColumns pairs{"pairs.csv", table_files::columnsOfCsv(parts[0], "pairs.csv")};
    const registration::NamedColumns poses{"poses.csv", table_files::columnsOfCsv(parts[1], "poses.csv")};
    const auto rows = registration::readPairTable(pairs, parts[1].empty() ? nullptr : &poses);
    constexpr std::size_t kEnough = 40;  // rows; registerPairs() takes long for many
    if (rows.size() > kEnough) return;
    const registration::PairPoints points = registration::pointsOf(rows, triangulator);
    fuzz::require(points.pairs.size() + points.skipped.size() == rows.size(), "each row is used or skipped");
    const auto result = registration::registerPairs(points.pairs);
    if (!result) return;
    fuzz::require(result->base_from_camera.matrix().allFinite(), "a registration is finite");
    fuzz::require(std::isfinite(result->rms) && result->covariance.allFinite(), "its uncertainty is finite");
  });
}
