// libFuzzer's entry: the only target that is linked.
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  capstan::fuzz::targets().front().run({reinterpret_cast<const char*>(data), size});
  return 0;
}
