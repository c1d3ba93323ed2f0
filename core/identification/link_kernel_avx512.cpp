#include "core/identification/link_kernel.inc"
