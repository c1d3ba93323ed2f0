#include "core/registration/stereo_fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/units.h"
#include "core/registration/camera_order.h"
#include "core/registration/pair_registration.h"

namespace capstan::registration {
namespace {

using vision::ImageCorrection;

constexpr double kAgree = 0.15;            // largest residual of a fit, as a share of the points' spread
constexpr double kLeastShare = 2.0 / 3.0;  // of the rows that agree

// Exchanged cameras first: where two corrections fit equally, it is the likelier one.
constexpr std::array kCorrections = {
    ImageCorrection{.exchange = true, .mirror = {}, .flip = {}},
    ImageCorrection{.exchange = false, .mirror = {true, true}, .flip = {}},
    ImageCorrection{.exchange = true, .mirror = {true, true}, .flip = {}},
    ImageCorrection{.exchange = false, .mirror = {true, false}, .flip = {}},
    ImageCorrection{.exchange = false, .mirror = {false, true}, .flip = {}},
    ImageCorrection{.exchange = false, .mirror = {true, false}, .flip = {true, false}},
    ImageCorrection{.exchange = false, .mirror = {false, true}, .flip = {false, true}},
    ImageCorrection{.exchange = false, .mirror = {}, .flip = {true, false}},
    ImageCorrection{.exchange = false, .mirror = {}, .flip = {false, true}}};

/// Points of the rows whose rays meet when the images are corrected.
std::vector<PointPair> pointsBy(const ImageCorrection& correction, std::span<const PairRow> rows,
                                const vision::Triangulator& triangulator) {
  const vision::Camera& camera = triangulator.rig().left;
  std::vector<PointPair> pairs;
  for (const PairRow& row : rows) {
    if (!row.pixels || !row.base) continue;
    const StereoPixels& seen = *row.pixels;
    const auto pixels = correction.apply(seen.left, seen.right, camera.width, camera.height);
    const auto met = triangulator.triangulate(pixels[0], pixels[1],
                                              correction.exchange ? seen.right_sigma : seen.left_sigma,
                                              correction.exchange ? seen.left_sigma : seen.right_sigma);
    if (met.found() && std::abs(met.epipolar_residual) <= kEpipolarLimit)
      pairs.push_back({met.position, *row.base});
  }
  return pairs;
}

double spreadOf(std::span<const PointPair> pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) mean += pair.base / static_cast<double>(pairs.size());
  double sum = 0.0;
  for (const PointPair& pair : pairs) sum += (pair.base - mean).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

/// RMS residual of the registration of the pairs; none where it does not count.
std::optional<double> fitOf(std::span<const PointPair> pairs, std::size_t rows) {
  const auto fit = registerPairs(pairs);
  if (!fit) return std::nullopt;
  const auto used = static_cast<double>(std::ranges::count(fit->used, true));
  if (used < kLeastShare * static_cast<double>(rows) || fit->rms > kAgree * spreadOf(pairs))
    return std::nullopt;
  return fit->rms;
}

}  // namespace

StereoFinding findStereoFault(std::span<const PairRow> rows, const vision::Triangulator& triangulator) {
  StereoFinding finding;
  finding.poses = rows.size();
  if (rows.size() < StereoWatch::kLeast) return finding;
  const std::vector<PointPair> plain = pointsBy({}, rows, triangulator);
  if (const auto rms = fitOf(plain, rows.size())) {
    finding.verdict = StereoVerdict::kFits;
    finding.rms = *rms;
    return finding;
  }
  const auto refused = registerPairs(plain);
  const bool met = static_cast<double>(plain.size()) >= kLeastShare * static_cast<double>(rows.size());
  if (!refused && met &&
      (refused.error().fault == PairFault::kCollinear || refused.error().fault == PairFault::kTooClose))
    return finding;
  if (!refused && refused.error().fault == PairFault::kScale) {
    std::vector<PointPair> scaled = plain;
    for (PointPair& pair : scaled) pair.camera *= refused.error().value;
    if (const auto rms = fitOf(scaled, rows.size())) {
      finding.verdict = StereoVerdict::kScale;
      finding.scale = refused.error().value;
      finding.rms = *rms;
      return finding;
    }
  }
  finding.verdict = StereoVerdict::kNoFit;
  for (const ImageCorrection& correction : kCorrections) {
    const auto rms = fitOf(pointsBy(correction, rows, triangulator), rows.size());
    if (!rms || (finding.verdict == StereoVerdict::kImages && *rms >= finding.rms)) continue;
    finding.verdict = StereoVerdict::kImages;
    finding.correction = correction;
    finding.rms = *rms;
  }
  return finding;
}

FindingWords wordsOf(const StereoFinding& finding, const vision::StereoRig& rig) {
  const ImageCorrection& fix = finding.correction;
  const bool exchanged = fix == ImageCorrection{.exchange = true, .mirror = {}, .flip = {}};
  switch (finding.verdict) {
    case StereoVerdict::kUnknown:
      return {fmt::format("{} of {} poses", finding.poses, StereoWatch::kLeast), "too few poses",
              "Move the arm slowly through its workspace in all three directions", ""};
    case StereoVerdict::kFits:
      return {fmt::format("fits to {:.1f} mm", base::toMillimetres(finding.rms)),
              fmt::format("{} poses fit", finding.poses), "", ""};
    case StereoVerdict::kImages:
      return {fix.words(), "wrong images: " + fix.words(),
              exchanged
                  ? "Exchange the cameras here, and left and right in the live set-up so that it stays"
                  : "Correct the images here, and switch the mirroring off at the camera so that it stays",
              exchanged ? "Exchange the cameras" : "Correct the images"};
    case StereoVerdict::kScale:
      return {fmt::format("base line × {:.3f}", finding.scale),
              fmt::format("wrong base line or board: the robot's lengths are {:.3f} times the cameras'",
                          finding.scale),
              fmt::format("Use a base line of {:.2f} mm instead of {:.2f} mm. Squares of the board that were "
                          "entered as 20 mm would be {:.2f} mm: calibrate again with the right ones",
                          base::toMillimetres(rig.baseline() * finding.scale),
                          base::toMillimetres(rig.baseline()), 20.0 * finding.scale),
              "Scale the base line"};
    case StereoVerdict::kNoFit:
      break;
  }
  return {"does not fit", fmt::format("{} poses do not fit", finding.poses),
          "Check that the camera files belong to these cameras, that both images are of the same time, and "
          "that the robot file is this robot's",
          ""};
}

vision::StereoRig scaledBaseline(vision::StereoRig rig, double scale) {
  rig.right_from_left.translation() *= scale;
  return rig;
}

bool StereoWatch::observe(const tracking::Snapshot& snapshot) {
  if (!snapshot.camera_updated || !snapshot.camera_images || !snapshot.tip_kin_cam.allFinite()) return false;
  const bool slow = speed_.to(snapshot) <= kSlow;  // false for the first sample: NaN
  if (!slow || !snapshot.marker[0].found() || !snapshot.marker[1].found()) return false;
  const bool apart = std::ranges::all_of(
      rows_, [&](const PairRow& row) { return (*row.base - snapshot.tip_kin_cam).norm() >= kApart; });
  if (!apart) return false;
  if (rows_.size() == kMost) rows_.erase(rows_.begin());
  PairRow row;
  row.base = snapshot.tip_kin_cam;
  row.pixels = StereoPixels{snapshot.marker[0].centroid, snapshot.marker[1].centroid,
                            snapshot.marker[0].sigma, snapshot.marker[1].sigma};
  rows_.push_back(row);
  finding_ = findStereoFault(rows_, triangulator_);
  return true;
}

}  // namespace capstan::registration
