#pragma once

#include <bit>
#include <cmath>

#include "core/robot/arm_kernel.h"

namespace capstan::robot {

/// Sines and cosines of q1 and q2 [rad], computed together in two SIMD lanes. The error is below 1.5e-16 up
/// to 1e5 rad; for larger or non-finite angles the C library is used. The C library would take half the time
/// of the forward dynamics, because its branches on the quadrant are mispredicted.
///
/// Method: reduction by multiples of pi/2 in three parts (Cody and Waite, Software Manual for the Elementary
/// Functions, 1980) and the minimax polynomials of fdlibm's k_sin.c and k_cos.c on [−pi/4, pi/4].
[[gnu::always_inline]] inline ArmTrig<double> armTrig(double q1, double q2) {
  constexpr double kLargest = 1e5;
  if (!(std::abs(q1) <= kLargest && std::abs(q2) <= kLargest))
    return {std::sin(q1), std::cos(q1), std::sin(q2), std::cos(q2)};

  using Pair [[gnu::vector_size(16)]] = double;
  using Bits [[gnu::vector_size(16)]] = long long;
  constexpr double kTwoOverPi = 0.63661977236758134308;
  constexpr double kRounder =
      6755399441055744.0;  // 1.5 * 2^52: leaves the nearest integer in the lowest bits
  constexpr double kHalfPi1 = 1.57079632673412561417e+00, kHalfPi2 = 6.07710050630396597660e-11,
                   kHalfPi3 = 2.02226624879595063154e-21;

  const Pair x = {q1, q2};
  const Pair shifted = x * kTwoOverPi + kRounder;
  const Pair turns = shifted - kRounder;
  const Pair r = ((x - turns * kHalfPi1) - turns * kHalfPi2) - turns * kHalfPi3;
  const Pair z = r * r;

  const Pair z2 = z * z;  // polynomials by Estrin's scheme: shorter chains than Horner's
  const Pair odd = (-1.66666666666666324348e-01 + z * 8.33333333332248946124e-03) +
                   z2 * ((-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06) +
                         z2 * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10));
  const Pair even = (4.16666666666666019037e-02 + z * -1.38888888888741095749e-03) +
                    z2 * ((2.48015872894767294178e-05 + z * -2.75573143513906633035e-07) +
                          z2 * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
  const Pair half = 0.5 * z;
  const Pair one = 1.0 - half;
  const Bits sine = std::bit_cast<Bits>(r + r * z * odd);
  const Bits cosine = std::bit_cast<Bits>(one + (((1.0 - one) - half) + z2 * even));

  const Bits quadrant = std::bit_cast<Bits>(shifted);
  const Bits swap = -(quadrant & 1LL);
  const Bits exchanged = (sine ^ cosine) & swap;
  const auto s = std::bit_cast<Pair>((sine ^ exchanged) ^ ((quadrant & 2LL) << 62));
  const auto c = std::bit_cast<Pair>((cosine ^ exchanged) ^ (((quadrant + 1LL) & 2LL) << 62));
  return {s[0], c[0], s[1], c[1]};
}

}  // namespace capstan::robot
