#include "core/math/blas_kernels.h"

#include <cblas.h>

#include <cstdlib>

#include "core/math/instruction_set.h"

// Not in OpenBLAS's header, and only in builds that contain the kernels of several processors.
extern "C" {
[[gnu::weak]] void gotoblas_dynamic_init();
[[gnu::weak]] void gotoblas_dynamic_quit();
}

namespace capstan::math {

void chooseBlasKernels() {
  constexpr const char* kVariable = "OPENBLAS_CORETYPE";
  if (!gotoblas_dynamic_init || !gotoblas_dynamic_quit || std::getenv(kVariable)) return;
  if (blasKernels() != "Prescott") return;
  const char* kernels = isAvailable(InstructionSet::kAvx512) ? "SkylakeX"
                        : isAvailable(InstructionSet::kAvx2) ? "Haswell"
                                                             : nullptr;
  if (!kernels) return;
  ::setenv(kVariable, kernels, 1);
  gotoblas_dynamic_quit();  // forgets the choice
  gotoblas_dynamic_init();
  ::unsetenv(kVariable);
}

std::string blasKernels() { return openblas_get_corename(); }

}  // namespace capstan::math
