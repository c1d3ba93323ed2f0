#include "core/recording/settle_units.h"
#include "core/robot/description.h"
#include "tests/fuzz/table_laws.h"

CAPSTAN_FUZZ_TARGET(measured_table) {
  using namespace capstan;
  static const robot::Description robot = robot::defaultDescription();
  fuzz::allowInputError([&] {
    recording::MeasuredTable table = recording::parseMeasuredTable(bytes, "table.csv");
    fuzz::requireTable(table);
    const std::string text = recording::formatMeasuredTable(table);
    fuzz::require(recording::formatMeasuredTable(recording::parseMeasuredTable(text, "again.csv")) == text,
                  "a table is read as it was written");
    recording::settleUnits(table, robot, {});
  });
}
