#include "core/table_files/json_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.h"
#include "core/base/nan.h"

namespace capstan::table_files {
namespace {

using Json = nlohmann::json;

/// A column while the file is being read.
struct Column {
  std::vector<double>* values = nullptr;  ///< null: ignored
  int line = 0;                           ///< last line that has the key
};

/// Takes the numbers of one object from the events of the JSON parser.
class RowTaker final : public Json::json_sax_t {
 public:
  RowTaker(std::string file, const ColumnTarget& target) : file_(std::move(file)), target_(target) {}

  void begin(int line) { line_ = line, depth_ = 0; }
  /// Gives the columns without a value in this row NaN.
  void finish() {
    ++rows_;
    for (std::vector<double>* values : taken_) values->resize(rows_, base::kNaN);
  }
  std::size_t rows() const { return rows_; }

  bool null() override { return depth_ > 0 || refuseLine("null"); }
  bool boolean(bool value) override { return take(base::kNaN, value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return take(static_cast<double>(value), {}); }
  bool number_unsigned(number_unsigned_t value) override { return take(static_cast<double>(value), {}); }
  bool number_float(number_float_t value, const string_t& text) override { return take(value, text); }
  bool string(string_t& value) override { return take(base::kNaN, value); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return ++depth_ == 1 || take(base::kNaN, "{…}"); }
  bool end_object() override { return --depth_, true; }
  bool start_array(std::size_t) override {
    if (depth_ == 0) return refuseLine("[…]");
    return ++depth_, take(base::kNaN, "[…]");
  }
  bool end_array() override { return --depth_, true; }

  bool key(string_t& name) override {
    if (depth_ != 1) return true;  // within a value that is ignored
    const auto found = columns_.find(name);
    at_ = found != columns_.end() ? found : added(name);
    if (std::exchange(at_->second.line, line_) == line_)
      throw base::InputError(
          {file_, line_, name, {}, "is in this object twice", "Give each column one value in a row"});
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const Json::exception&) override {
    throw base::InputError({file_,
                            line_,
                            {},
                            {},
                            fmt::format("is not JSON from byte {} on", position),
                            "Write one object a line, {\"t\": 0.001, \"q_m1\": 81.2}, and null where there "
                            "is no value"});
  }

 private:
  using Columns = std::map<std::string, Column, std::less<>>;

  Columns::iterator added(const std::string& name) {
    std::vector<double>* values = target_(name, columns_.size());
    if (values) taken_.push_back(values);
    return columns_.emplace(name, Column{values, 0}).first;
  }
  bool take(double value, const std::string& text) {
    if (depth_ == 0) return refuseLine(text);
    if (columns_.empty() || !at_->second.values) return true;
    if (!std::isfinite(value))
      throw base::InputError({file_, line_, at_->first, text, "is not a finite number",
                              "Write a decimal number, or null where there is no value"});
    at_->second.values->resize(rows_, base::kNaN);
    at_->second.values->push_back(value);
    return true;
  }
  [[noreturn]] bool refuseLine(const std::string& text) const {
    throw base::InputError({file_,
                            line_,
                            {},
                            text,
                            "is no JSON object",
                            "Write one object a line, {\"t\": 0.001, \"q_m1\": 81.2}"});
  }

  std::string file_;
  const ColumnTarget& target_;
  Columns columns_;
  Columns::iterator at_;
  std::vector<std::vector<double>*>
      taken_;  ///< of the columns that are not ignored: few, whatever the file has
  std::size_t rows_ = 0;
  int line_ = 0, depth_ = 0;
};

/// Reads the next line without its line end. False: the file has ended.
bool nextLine(std::istream& in, std::string& line, const std::string& file, int number) {
  line.clear();
  for (std::streambuf& bytes = *in.rdbuf();;) {
    const int byte = bytes.sbumpc();
    if (byte == std::char_traits<char>::eof()) return !line.empty();
    if (byte == '\n') return true;
    if (line.size() == kLongestJsonLine)
      throw base::InputError({file,
                              number,
                              {},
                              {},
                              fmt::format("has more than {} bytes", kLongestJsonLine),
                              "Write one object a line, each ended by a line feed"});
    line += static_cast<char>(byte);
  }
}

bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

}  // namespace

void readFirstJsonLine(std::istream& in, const std::string& file, const ColumnTarget& target) {
  std::string line;
  nextLine(in, line, file, 1);
  std::istringstream first(line);
  readJsonLines(first, file, target);
}

void readJsonLines(std::istream& in, const std::string& file, const ColumnTarget& target) {
  RowTaker taker(file, target);
  std::string line;
  int number = 1, blank = 0;
  for (; nextLine(in, line, file, number); ++number) {
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (isBlank(line)) {
      if (blank == 0) blank = number;
      continue;
    }
    if (blank > 0)
      throw base::InputError({file, blank, {}, {}, "is empty", "Remove the empty lines between the rows"});
    taker.begin(number);
    Json::sax_parse(line, &taker);
    taker.finish();
  }
  if (taker.rows() == 0)
    throw base::InputError({file, 1, {}, {}, "has no rows", "Add at least one row of values"});
}

void readJsonLines(const std::filesystem::path& path, const ColumnTarget& target) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw base::InputError(
        {path.string(), 0, {}, {}, "cannot be opened", "Check the path and its permissions"});
  readJsonLines(in, path.string(), target);
}

}  // namespace capstan::table_files
