#pragma once

#include <stdexcept>
#include <string>

namespace capstan::base {

/// Where and why an input was refused, and what its owner can do about it. Empty parts are left out of
/// what().
struct InputFault {
  std::string file;    ///< path, or the name of the option or stream
  int line = 0;        ///< 1-based; 0: the file as a whole
  std::string key;     ///< field, column or option
  std::string value;   ///< the offending text as written
  std::string reason;  ///< what is wrong with it
  std::string remedy;  ///< what to do, as an imperative sentence
};

/// A file or an argument from outside is unusable. what() reads
/// `FILE:LINE: KEY = VALUE: REASON. REMEDY`, of a long value its beginning.
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputFault fault);
  const InputFault& fault() const { return fault_; }

 private:
  InputFault fault_;
};

}  // namespace capstan::base
