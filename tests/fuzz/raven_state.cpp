#include "core/ros1/raven_state.h"

#include "core/base/error.h"
#include "tests/fuzz/fuzz_target.h"

/// The definition of a raven_state; behind "====", a message.
CAPSTAN_FUZZ_TARGET(raven_state) {
  using namespace capstan;
  const auto parts = fuzz::partsOf(bytes, 2);
  fuzz::allowInputError([&] {
    base::namingFile("trial.bag", [&] {
      const ros1::RavenStateLayout layout(parts[0]);
      layout.read(ros1::Bytes(parts[1].begin(), parts[1].end()));
    });
  });
}
