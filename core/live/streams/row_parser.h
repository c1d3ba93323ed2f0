#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::live {

/// Rows of a measured table that come in pieces: a header line, then a line per row. The first kFirstRows
/// rows are held back until all of them are there, because units are judged by their values; each line is
/// checked as soon as it is complete.
class RowParser {
 public:
  /// `name`: of the stream, for errors.
  RowParser(std::string name, robot::Description robot, recording::ReadAs read_as);

  /// Forgets everything: what follows begins with a header line.
  void restart();
  /// Adds bytes.
  void add(std::string_view bytes) { pending_.append(bytes); }
  /// Rows of the complete lines that were added, in SI; `ended`: the last line may lack its line end. Nothing
  /// if there are none. Throws base::InputError with line, column, value and remedy as parseMeasuredRows(),
  /// as checkForTracking() while the first rows are held back, as settleUnits(), and for a line of more than
  /// kLongestLine bytes.
  std::optional<recording::MeasuredTable> take(bool ended);

  /// Discards a row that has no line end yet: its connection has ended, and the last number may be cut off.
  /// Returns whether there was one.
  bool discardIncomplete();

  /// Throws base::InputError if the times of `rows`, which take() has just returned, do not rise.
  void checkOrder(const recording::MeasuredTable& rows);

  static constexpr std::size_t kFirstRows = 50;
  static constexpr std::size_t kLongestLine = 1U << 16;

 private:
  recording::MeasuredTable parse(std::string_view lines, std::size_t before) const;
  void checkHeld(std::size_t complete);

  const std::string name_;
  const robot::Description robot_;
  const recording::ReadAs read_as_;
  std::string header_, pending_;
  std::size_t lines_ = 0;               ///< before pending_
  std::optional<std::size_t> checked_;  ///< bytes of pending_ that checkHeld() has parsed; nothing: none
  bool units_settled_ = false;
  double last_t_ = -std::numeric_limits<double>::infinity();  ///< of checkOrder() [s]
};

}  // namespace capstan::live
