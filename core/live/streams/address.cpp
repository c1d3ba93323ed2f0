#include "core/live/streams/address.h"

#include <arpa/inet.h>

#include <charconv>

#include "core/base/error.h"

namespace capstan::live {
namespace {

constexpr std::string_view kTcp = "tcp://";

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& reason) {
  throw base::InputError({"", 0, option, text, reason,
                          "Give - for standard input, the path of a FIFO, or tcp://ADDRESS:PORT, such as "
                          "tcp://127.0.0.1:5555"});
}

}  // namespace

bool isAddress(const std::string& text) { return text == "-" || text.starts_with(kTcp); }

Address parseAddress(const std::string& text, const std::string& option) {
  if (text.empty()) refuse(option, text, "is empty");
  if (text == "-") return {};
  if (!text.starts_with(kTcp)) {
    if (text.find("://") != std::string::npos) refuse(option, text, "has a scheme that is not known");
    return {.kind = Address::Kind::kFile, .path = text};
  }
  const std::string rest = text.substr(kTcp.size());
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string::npos) refuse(option, text, "names no port");
  Address address{.kind = Address::Kind::kTcp, .path = {}, .host = rest.substr(0, colon), .port = 0};
  if (address.host == "localhost") address.host = "127.0.0.1";
  in_addr parsed{};
  if (inet_pton(AF_INET, address.host.c_str(), &parsed) != 1)
    refuse(option, text, "has a host that is no IPv4 address");
  const char *begin = rest.data() + colon + 1, *end = rest.data() + rest.size();
  const auto [last, fault] = std::from_chars(begin, end, address.port);
  if (fault != std::errc() || last != end || begin == end)
    refuse(option, text, "has a port that is no number from 0 to 65535");
  return address;
}

}  // namespace capstan::live
