#include "core/math/triangularise_kernel.inc"
