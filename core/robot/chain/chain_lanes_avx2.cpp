#include "core/robot/chain/chain_lanes.inc"
