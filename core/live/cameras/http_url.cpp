#include "core/live/cameras/http_url.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "core/base/error.h"

namespace capstan::live {
namespace {

constexpr std::string_view kScheme = "http://";
constexpr int kLargestPort = 65535;

/// The whole of `text` as a number to `base`; negative: it is none.
int numberOf(std::string_view text, int base) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc() && end == text.data() + text.size() ? value : -1;
}

/// `text` with the characters that are written as %XX.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const int code = text[k] == '%' && k + 2 < text.size() ? numberOf(text.substr(k + 1, 2), 16) : -1;
    result += code < 0 ? text[k] : static_cast<char>(code);
    if (code >= 0) k += 2;
  }
  return result;
}

}  // namespace

HttpUrl parseHttpUrl(const std::string& address) {
  HttpUrl url;
  std::string_view rest = std::string_view(address).substr(kScheme.size());
  const std::size_t slash = std::min(rest.find_first_of("/?"), rest.size());
  url.path = rest.substr(slash);
  if (!url.path.starts_with('/')) url.path.insert(0, "/");
  rest = rest.substr(0, slash);
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    const std::size_t colon = std::min(rest.find(':'), at);
    url.user = decoded(rest.substr(0, colon));
    if (colon < at) url.password = decoded(rest.substr(colon + 1, at - colon - 1));
    rest = rest.substr(at + 1);
  }
  // Host, then nothing or ":PORT".
  const bool bracketed = rest.starts_with('[');
  const std::size_t end = std::min(rest.find(bracketed ? ']' : ':'), rest.size());
  url.host = rest.substr(bracketed ? 1 : 0, end - (bracketed ? 1 : 0));
  const bool closed = !bracketed || end < rest.size();
  const std::string_view after = rest.substr(std::min(end + (bracketed ? 1 : 0), rest.size()));
  if (!after.empty()) url.port = after[0] == ':' ? numberOf(after.substr(1), 10) : -1;
  if (url.host.empty() || !closed || url.port < 1 || url.port > kLargestPort)
    throw base::InputError({withoutPassword(address),
                            0,
                            {},
                            {},
                            "not an address of the form http://HOST:PORT/PATH",
                            "Correct the address"});
  return url;
}

std::string withoutPassword(const std::string& address) {
  const std::size_t scheme = address.find("://");
  if (scheme == std::string::npos) return address;
  const std::size_t begin = scheme + 3, end = std::min(address.find_first_of("/?", begin), address.size());
  const std::size_t at = address.rfind('@', end);
  return at == std::string::npos || at < begin ? address : address.substr(0, begin) + address.substr(at + 1);
}

bool isHttpAddress(const std::string& address) { return address.starts_with(kScheme); }

}  // namespace capstan::live
