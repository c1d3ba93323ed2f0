#pragma once

#include <string>

namespace capstan::math {

/// Has OpenBLAS use the kernels of the widest instruction set that this processor has. OpenBLAS chooses them
/// by the processor's model, and takes those of 2004 (SSE3) for models that are newer than itself. Nothing
/// changes where OpenBLAS knows the processor, or where the environment variable OPENBLAS_CORETYPE names the
/// kernels. Call it before the first thread that uses BLAS.
void chooseBlasKernels();

/// OpenBLAS's name of the kernels in use, such as "Haswell".
std::string blasKernels();

}  // namespace capstan::math
