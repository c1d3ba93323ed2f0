#pragma once

#include <string>

namespace capstan::base {

/// Text of a number in which a leading hyphen is replaced by a minus sign (U+2212).
inline std::string withMinus(std::string number) {
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

}  // namespace capstan::base
