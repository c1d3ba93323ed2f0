#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace capstan::base {
namespace {

/// Part of a value that fits a message: at most kLongest bytes of its first line, in whole UTF-8 characters.
std::string excerpt(const std::string& value) {
  constexpr std::size_t kLongest = 80;
  std::size_t length = std::min(value.find_first_of("\r\n"), value.size());
  if (length > kLongest) {
    length = kLongest;
    while (length > 0 && (static_cast<unsigned char>(value[length]) & 0xc0U) == 0x80U) --length;
  }
  return length == value.size() ? value : value.substr(0, length) + "…";
}

/// The text with its control characters written out: a terminal would obey them, and the C string what() ends
/// at a NUL.
std::string plain(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f)
      shown += fmt::format("\\x{:02x}", byte);
    else
      shown += c;
  }
  return shown;
}

std::string sentence(const InputFault& fault) {
  std::string text = fault.file;
  if (fault.line > 0) text += fmt::format(":{}", fault.line);
  if (!text.empty()) text += ": ";
  if (!fault.key.empty()) text += excerpt(fault.key);
  if (!fault.value.empty()) text += (fault.key.empty() ? "" : " = ") + excerpt(fault.value);
  if (!fault.key.empty() || !fault.value.empty()) text += ": ";
  text += fault.reason;
  if (!fault.remedy.empty()) text += (fault.remedy.front() == '\n' ? "" : ". ") + fault.remedy;
  return plain(text);
}

}  // namespace

InputError::InputError(InputFault fault) : std::runtime_error(sentence(fault)), fault_(std::move(fault)) {}

}  // namespace capstan::base
