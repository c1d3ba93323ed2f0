#include "core/live/streams/row_parser.h"
#include "core/live/streams/row_times.h"
#include "core/recording/table_source.h"
#include "tests/fuzz/table_laws.h"

/// Rows from TCP, a FIFO or standard input, in pieces as they may come. The first byte is the size of the
/// pieces; if it is odd, the rows are those of a file and must be in order, else those of a robot in real
/// time.
CAPSTAN_FUZZ_TARGET(row_stream) {
  using namespace capstan;
  static const robot::Description robot = robot::defaultDescription();
  if (bytes.empty()) return;
  const auto first = static_cast<unsigned char>(bytes.front());
  bytes.remove_prefix(1);
  const std::size_t piece = 1 + std::size_t{first} * 8;
  const bool ordered = first % 2 == 1;
  live::RowParser parser("rows", robot, {});
  live::RowTimes times;
  double arrival = 0.0, last = -1.0;
  while (!bytes.empty()) {
    const std::size_t size = std::min(piece, bytes.size());
    parser.add(bytes.substr(0, size));
    bytes.remove_prefix(size);
    arrival += 0.01;
    bool accepted = false;
    fuzz::allowInputError([&] {
      auto rows = parser.take(bytes.empty());
      if (rows) {
        fuzz::requireColumns(*rows);
        recording::checkForTracking(*rows, robot);
        if (ordered) {
          parser.checkOrder(*rows);
          fuzz::requireTable(*rows);
        } else {
          for (const double t : rows->t) {
            const auto time = times.of(t, arrival);
            if (!time) continue;
            fuzz::require(std::isfinite(*time) && *time > last, "the session's time rises");
            last = *time;
          }
        }
      }
      accepted = true;
    });
    if (!accepted) parser.restart();
  }
}
