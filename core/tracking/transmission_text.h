#pragma once

#include <string>
#include <vector>

#include "core/tracking/transmission_estimate.h"

namespace capstan::tracking {

/// Errors that the augmented filter includes, one line per error, for people: "joint 1: cable travel +6.97 ±
/// 0.10 % of nominal (pulley radius)", "joint 3: cable zero −2.06 ± 0.09 mm off (homing)", "joint 2: cable
/// stiffness 0.4 times that of the robot file", "cameras moved since their registration: 0.62°, 12.1 mm",
/// "camera stamps 60 ms late". Another line reports a change that is in question. Empty: no error is
/// included.
std::vector<std::string> linesOf(const TransmissionEstimate& found);

/// Where the delay of camera stamps is set.
enum class DelayField {
  kOptions,    ///< camera_delay of the filter options
  kLiveSetup,  ///< cameras.latency of a live set-up
};

/// Remedies, one sentence per kind of error: "A constant of the robot file is wrong: identify it.", "The
/// cameras are not where they were registered: register them again." Empty: no error is included.
std::vector<std::string> remediesOf(const TransmissionEstimate& found,
                                    DelayField delay_field = DelayField::kOptions);

/// Short form of linesOf() for a status line: "q1 travel +7.0 %, q3 zero −2.1 mm".
std::string shortTextOf(const TransmissionEstimate& found);

}  // namespace capstan::tracking
