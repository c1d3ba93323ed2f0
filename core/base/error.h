#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace capstan::base {

/// Location of a refused input, reason of the refusal and remedy. InputError::what() omits empty parts.
struct InputFault {
  std::string file;    ///< path, or the name of the option or stream
  int line = 0;        ///< 1-based; 0: the file as a whole
  std::string key;     ///< field, column or option
  std::string value;   ///< the offending text as written
  std::string reason;  ///< what is wrong with the value
  std::string remedy;  ///< what the user has to do, as an imperative sentence
};

/// Exception for an unusable file or argument from outside. what() reads
/// `FILE:LINE: KEY = VALUE: REASON. REMEDY`, with a long value cut off after its beginning.
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputFault fault);
  const InputFault& fault() const { return fault_; }

 private:
  InputFault fault_;
};

/// Returns work(). An InputError that `work` throws without a file name is rethrown with the name `file`.
template <class Work>
auto namingFile(const std::string& file, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    if (!error.fault().file.empty()) throw;
    InputFault fault = error.fault();
    fault.file = file;
    throw InputError(std::move(fault));
  }
}

}  // namespace capstan::base
