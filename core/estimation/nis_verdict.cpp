#include "core/estimation/nis_verdict.h"

namespace capstan::estimation {

std::string_view adviceOf(NisVerdict verdict) {
  switch (verdict) {
    case NisVerdict::kTooHigh:
      return "a parameter of the robot file is wrong: see identify and diagnose";
    case NisVerdict::kCautious:
      return "the filter expects more noise than there is, so its standard deviations are too large";
    case NisVerdict::kPass:
      break;
  }
  return {};
}

}  // namespace capstan::estimation
