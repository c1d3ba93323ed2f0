#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace capstan::base {

/// Where and why an input was refused, and what its owner can do about it. Empty parts are omitted from
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

/// Calls `work`; an InputError of it that names no file gets this one.
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
