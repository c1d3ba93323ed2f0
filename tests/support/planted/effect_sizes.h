#pragma once

#include "tests/support/planted/planted_sensors.h"

namespace capstan::test {

/// `effect` on joint i (from 0) of the largest size that a working robot could have. Direction, phase, speed,
/// time constant and so on are drawn at random. `p` is the worn robot without effects.
Planted largestPlausible(Effect effect, int i, const PlantParameters& p, const robot::Description& nominal,
                         base::Random& random);

/// Background effects of every joint: friction that is a few per cent higher in one direction, slight
/// Stribeck friction, and in a cable drive a capstan that is eccentric by some micrometres.
std::vector<Planted> backgroundTexture(const PlantParameters& p, base::Random& random, double factor = 1.0);

/// Computes how visible an effect is: the change of the readings that it causes, without the part that a
/// robot without a fault could show too. The change is simulated open loop over the motion of the robot
/// without the effect; that of a rigid drive starts again from the recorded state after every 0.5 s, since
/// torques say less and less about the position. The part that drift and texture within their drawn ranges
/// can imitate is subtracted, to first order. For example, a little more mass at the tip is a mistuned mass,
/// and 2 % of asymmetry is texture.
class Visibility {
 public:
  Visibility(const robot::Description& nominal, const robot::Description& worn, bool rigid,
             const Ageing& ageing, const std::vector<Planted>& texture, const SensorOptions& sensors,
             PlantedMotion motion);

  /// Visibility of an effect: RMS of the change beyond drift and texture over RMS of noise and texture, in
  /// the channel (a joint encoder or the cameras) where this ratio is largest. In rigid drives the change by
  /// torques between the rows of the table is noise, too, and texture is none but for effects that shift what
  /// sensors or a compliant cable show.
  double of(const Planted& planted) const;

 private:
  PlantedMotion replayOf(const robot::Description& robot, const std::vector<Planted>& effects) const;
  /// Simulated readings, one row per instant: joints [rad or m], then the tip [m].
  Eigen::MatrixXd tell(const PlantedMotion& motion, const std::vector<Planted>& effects) const;
  Eigen::MatrixXd changeBy(const std::vector<Planted>& effects) const;
  /// By torques of a rigid drive between the rows of the table.
  Eigen::MatrixXd changeByRows() const;
  Eigen::VectorXd channels(const Eigen::MatrixXd& change) const;  ///< RMS of each joint and of the tip
  Eigen::VectorXd weighted(const Eigen::MatrixXd& change) const;
  void findBackgroundChanges(const Ageing& ageing);

  robot::Description nominal_, worn_;
  PlantParameters parameters_;
  SensorOptions sensors_;
  PlantedMotion recorded_, plain_motion_;
  Eigen::MatrixXd plain_;
  /// Per channel of channels(): noise; noise and what the table lacks; these and texture together.
  Eigen::VectorXd noise_, unexplained_, level_;
  /// Change of the readings J per standard deviation of each background change, JᵀJ, and the bounds of the
  /// changes.
  Eigen::MatrixXd background_, normal_;
  Eigen::VectorXd low_, high_;
};

/// Visibility at size 1. A just visible effect has the visibility 1.
inline constexpr double kLargeVisibility = 10.0;

/// Effect with its visibility.
struct Sized {
  Planted planted;
  double visibility = 0.0;
};

/// Visibility at `size`, for an effect with the largest possible visibility `most`. It rises from 1 at size
/// 0.1 to min(kLargeVisibility, most) at size 1, evenly on a logarithmic scale. It is size × most if `most`
/// is below 1, and size × kLargeVisibility above size 1.
double visibilityOf(double size, double most);

/// `largest`, reduced so that its visibility is visibilityOf(size, its own visibility) within a quarter. It
/// is not changed if that is more than its own visibility, and neither is sensor_sign. size > 0.
Sized sizedTo(double size, const Planted& largest, const Visibility& visibility);

}  // namespace capstan::test
