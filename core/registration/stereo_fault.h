#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/registration/pair_table.h"
#include "core/registration/tip_speed.h"
#include "core/tracking/snapshot.h"
#include "core/vision/image_correction.h"
#include "core/vision/triangulation.h"

/// Recognises cameras that are exchanged, mirrored, upside down or calibrated with a wrong base line, from
/// the marker's pixels and the tip by transmission kinematics at several poses. Needs no registration.
namespace capstan::registration {

enum class StereoVerdict {
  kUnknown,  ///< too few poses, or poses too close together
  kFits,     ///< the points of the cameras and of the robot differ by a rigid motion
  kImages,   ///< they do so when the images are corrected
  kScale,    ///< they do so when the base line is scaled
  kNoFit     ///< they do so in none of these ways
};

struct StereoFinding {
  StereoVerdict verdict = StereoVerdict::kUnknown;
  std::size_t poses = 0;               ///< number of poses
  vision::ImageCorrection correction;  ///< kImages: what corrects the images
  double scale = 1.0;                  ///< kScale: true base line over the calibration's
  double rms = 0.0;                    ///< RMS residual of the fit [m]; kFits, kImages, kScale
};

/// Fits the rows as they are; then with images exchanged, mirrored (both, left, right), exchanged and
/// mirrored, upside down (left, right); then with a scaled base line. A fit counts where at least two thirds
/// of the rows agree with it to 15 % of their spread. Of several, the one with the smallest residual. At
/// least six rows with pixels and tip.
StereoFinding findStereoFault(std::span<const PairRow> rows, const vision::Triangulator& triangulator);

struct FindingWords {
  std::string value;   ///< what is the case, in a few words
  std::string reason;  ///< the same, with its numbers
  std::string remedy;  ///< what to do; empty: nothing
  std::string button;  ///< text of the button that does it; empty: a person has to
};
FindingWords wordsOf(const StereoFinding& finding, const vision::StereoRig& rig);

/// `rig` with the base line scaled.
vision::StereoRig scaledBaseline(vision::StereoRig rig, double scale);

/// Collects poses from a session: both cameras see the marker, the tip is slower than kSlow and kApart away
/// from the tip at every other pose.
class StereoWatch {
 public:
  static constexpr double kApart = 0.015;   ///< [m]
  static constexpr double kSlow = 0.05;     ///< [m/s]; 5 ms of clock error are then 0.25 mm
  static constexpr std::size_t kMost = 40;  ///< number of poses; new ones replace the oldest
  static constexpr std::size_t kLeast = 6;  ///< number of poses for a finding

  explicit StereoWatch(const vision::StereoRig& rig) : triangulator_(rig) {}
  /// Takes the next snapshot, in order. Returns true when a pose was added, which renews finding().
  bool observe(const tracking::Snapshot& snapshot);
  const StereoFinding& finding() const { return finding_; }
  const vision::StereoRig& rig() const { return triangulator_.rig(); }

 private:
  vision::Triangulator triangulator_;
  std::vector<PairRow> rows_;
  StereoFinding finding_;
  TipSpeed speed_;
};

}  // namespace capstan::registration
