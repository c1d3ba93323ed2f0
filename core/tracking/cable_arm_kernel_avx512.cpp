#include "core/tracking/cable_arm_kernel.inc"
