#pragma once

#include "tests/support/planted/planted_sensors.h"

namespace capstan::test {

/// `effect` on joint i (from 0) as large as a robot that still works could have it; direction, phase, speed,
/// time constant and so on drawn. `p`: the drifted robot without effects.
Planted largestPlausible(Effect effect, int i, const PlantParameters& p, const robot::Description& nominal,
                         base::Random& random);

/// Background texture of every joint: friction a few per cent stronger one way, in a cable drive a capstan
/// some micrometres out of centre, a trace of Stribeck.
std::vector<Planted> backgroundTexture(const PlantParameters& p, base::Random& random);

/// How much of an effect a reference would show that no robot without a fault would: open-loop simulations
/// over the motion of the robot without it, less what drift and texture, as far as they are drawn and to
/// first order, can do to look like it. A little more mass at the tip is a mistuned mass, and 2 % of
/// asymmetry are texture.
class Visibility {
 public:
  Visibility(const robot::Description& nominal, const robot::Description& worn, bool rigid,
             const std::vector<Planted>& texture, const SensorOptions& sensors, PlantedMotion motion);

  /// RMS of what the effect changes beyond drift and texture, over RMS of noise and texture, of the channel
  /// (a joint encoder, the cameras) that shows most of it.
  double of(const Planted& planted) const;

 private:
  PlantedMotion replayOf(const robot::Description& robot, const std::vector<Planted>& effects) const;
  /// What the sensors would tell, a row an instant: joints [rad or m], then the tip [m].
  Eigen::MatrixXd tell(const PlantedMotion& motion, const std::vector<Planted>& effects) const;
  Eigen::MatrixXd changeBy(const std::vector<Planted>& effects) const;
  Eigen::VectorXd channels(const Eigen::MatrixXd& change) const;  ///< RMS of each joint and of the tip
  Eigen::VectorXd weighted(const Eigen::MatrixXd& change) const;
  void findBackgroundChanges();

  robot::Description nominal_, worn_;
  PlantParameters parameters_;
  SensorOptions sensors_;
  PlantedMotion recorded_, plain_motion_;
  Eigen::MatrixXd plain_;
  Eigen::VectorXd noise_, level_;  ///< of channels(); level_: noise and texture together
  /// What one standard deviation of each background change does to the readings, JᵀJ, and how far each may
  /// go.
  Eigen::MatrixXd background_, normal_;
  Eigen::VectorXd low_, high_;
};

/// Visibility at size 1; just visible, 1, is a tenth of it.
inline constexpr double kLargeVisibility = 10.0;

struct Sized {
  Planted planted;
  double visibility = 0.0;
};

/// Visibility at `size` of an effect that shows at most `most`: on a logarithmic scale from 1 at size 0.1 to
/// kLargeVisibility at 1, or to `most` where that is less; size times `most` where that is not even 1; above
/// size 1 size times kLargeVisibility.
double visibilityOf(double size, double most);

/// `largest` made so much smaller that its visibility is visibilityOf(size, its own), within a quarter; as it
/// is where that is more than it has. size > 0. sensor_sign stays as it is.
Sized sizedTo(double size, const Planted& largest, const Visibility& visibility);

}  // namespace capstan::test
