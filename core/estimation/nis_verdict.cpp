#include "core/estimation/nis_verdict.h"

namespace capstan::estimation {

std::string_view adviceOf(NisVerdict verdict) {
  switch (verdict) {
    case NisVerdict::kTooHigh:
      return "the filter errs by more than it states, as with a wrong parameter of the robot file or cameras "
             "that "
             "were moved: see identify and diagnose";
    case NisVerdict::kCautious:
      return "the camera agrees with the filter more closely than the filter expects";
    case NisVerdict::kPass:
      break;
  }
  return {};
}

}  // namespace capstan::estimation
