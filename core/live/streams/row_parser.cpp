#include "core/live/streams/row_parser.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/recording/settle_units.h"
#include "core/recording/table_source.h"

namespace capstan::live {

using recording::MeasuredTable;

RowParser::RowParser(std::string name, robot::Description robot, recording::ReadAs read_as)
    : name_(std::move(name)), robot_(std::move(robot)), read_as_(std::move(read_as)) {}

void RowParser::restart() {
  header_.clear(), pending_.clear();
  lines_ = 0, checked_.reset();
  units_settled_ = false;
}

/// Parses lines that `before` lines of the stream precede.
MeasuredTable RowParser::parse(std::string_view lines, std::size_t before) const {
  try {
    return recording::parseMeasuredRows(header_ + std::string(lines), name_);
  } catch (const base::InputError& error) {
    base::InputFault fault = error.fault();
    if (fault.line > 1) fault.line += static_cast<int>(before) - 1;
    throw base::InputError(std::move(fault));
  }
}

/// Checks columns and cells of the lines in pending_[0, complete) that are held back.
void RowParser::checkHeld(std::size_t complete) {
  if (header_.empty() || checked_ == complete) return;
  const std::size_t begin = checked_.value_or(0);
  const std::string_view held = pending_;
  const auto before = lines_ + static_cast<std::size_t>(std::ranges::count(held.substr(0, begin), '\n'));
  std::string_view lines = held.substr(begin, complete - begin);
  std::string zeros = "0";  // a row for a header that has none yet
  if (lines.empty()) {
    for (auto commas = std::ranges::count(header_, ','); commas > 0; --commas) zeros += ",0";
    lines = zeros;
  }
  recording::checkForTracking(parse(lines, before), robot_);
  checked_ = complete;
}

bool RowParser::discardIncomplete() {
  const std::size_t last = pending_.rfind('\n');
  if (pending_.empty() || (header_.empty() && last == std::string::npos)) return false;
  const std::size_t complete = last == std::string::npos ? 0 : last + 1;
  const bool any = complete < pending_.size();
  pending_.erase(complete);
  return any;
}

std::optional<MeasuredTable> RowParser::take(bool ended) {
  if (ended && !pending_.empty() && pending_.back() != '\n') pending_ += '\n';
  if (header_.empty()) {
    const std::size_t end = pending_.find('\n');
    if (end != std::string::npos) {
      header_ = pending_.substr(0, end + 1);
      pending_.erase(0, end + 1);
      lines_ = 1;
    }
  }
  const std::size_t last = pending_.rfind('\n');
  const std::size_t complete = last == std::string::npos ? 0 : last + 1;
  if (pending_.size() - complete > kLongestLine)
    throw base::InputError({name_,
                            static_cast<int>(lines_) + 1,
                            {},
                            {},
                            fmt::format("a line has more than {} bytes", kLongestLine),
                            "Send rows of a measured table, each ended by a line feed"});
  const auto rows = static_cast<std::size_t>(
      std::count(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(complete), '\n'));
  if (!units_settled_ && !ended && rows < kFirstRows) return checkHeld(complete), std::nullopt;
  if (complete == 0) return {};
  MeasuredTable table = parse(std::string_view(pending_).substr(0, complete), lines_);
  if (units_settled_)
    recording::readColumnsAs(table, robot_, read_as_);
  else
    recording::settleUnits(table, robot_, read_as_);
  recording::checkTimeRange(table);
  units_settled_ = true;
  table.lines.first = static_cast<int>(lines_) + 1;
  pending_.erase(0, complete);
  lines_ += rows;
  return table;
}

void RowParser::checkOrder(const MeasuredTable& rows) {
  recording::checkTimes(rows, last_t_);
  last_t_ = rows.t.back();
}

}  // namespace capstan::live
