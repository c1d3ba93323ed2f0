#include "core/base/error.h"

#include <fmt/format.h>

namespace capstan::base {
namespace {

std::string sentence(const InputFault& fault) {
  std::string text = fault.file;
  if (fault.line > 0) text += fmt::format(":{}", fault.line);
  if (!text.empty()) text += ": ";
  if (!fault.key.empty()) text += fault.key;
  if (!fault.value.empty()) text += fmt::format(" = {}", fault.value);
  if (!fault.key.empty() || !fault.value.empty()) text += ": ";
  text += fault.reason;
  if (!fault.remedy.empty()) text += ". " + fault.remedy;
  return text;
}

}  // namespace

InputError::InputError(InputFault fault) : std::runtime_error(sentence(fault)), fault_(std::move(fault)) {}

}  // namespace capstan::base
