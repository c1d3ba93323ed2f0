#pragma once

#include <string>

namespace capstan::base {

/// A number's text with a minus (U+2212) in front where it had a hyphen.
inline std::string withMinus(std::string number) {
  if (number.starts_with('-')) number.replace(0, 1, "−");
  return number;
}

}  // namespace capstan::base
