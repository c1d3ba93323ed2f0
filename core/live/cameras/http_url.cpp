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
  const std::size_t bracket = rest.starts_with('[') ? rest.find(']') : 0;
  const std::size_t colon = bracket == std::string_view::npos ? bracket : rest.find(':', bracket);
  url.host = rest.substr(bracket > 0 ? 1 : 0, bracket > 0 ? bracket - 1 : colon);
  if (colon < rest.size()) url.port = numberOf(rest.substr(colon + 1), 10);
  if (url.host.empty() || url.port < 1 || url.port > kLargestPort)
    throw base::InputError({address,
                            0,
                            {},
                            {},
                            "not an address of the form http://HOST:PORT/PATH",
                            "Correct the address"});
  return url;
}

bool isHttpAddress(const std::string& address) { return address.starts_with(kScheme); }

}  // namespace capstan::live
