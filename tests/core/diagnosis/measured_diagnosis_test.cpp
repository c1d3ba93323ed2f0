// What a diagnosis names in recordings of real robots, where they are on this machine.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/measured_diagnosis/emps.h"
#include "tests/support/measured_diagnosis/jaw.h"
#include "tests/support/measured_diagnosis/steps.h"

namespace capstan::measured {
namespace {

#define REQUIRE_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << (path) << " is not on this machine"

