#include "core/recording/read_table.h"
#include "core/robot/description.h"
#include "tests/fuzz/table_laws.h"

/// A recording by the RAVEN-II's own software, or whatever readTable() takes the file for.
CAPSTAN_FUZZ_TARGET(motor_log) {
  using namespace capstan;
  static const robot::Description robot = robot::defaultDescription();
  fuzz::allowInputError(
      [&] { fuzz::requireTable(recording::readTable(fuzz::fileOf(bytes, "motors.csv"), robot)); });
}
