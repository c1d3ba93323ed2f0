#include "core/live/streams/address.h"

#include <arpa/inet.h>

#include <charconv>
#include <utility>

#include "core/base/error.h"

namespace capstan::live {
namespace {

constexpr std::string_view kTcp = "tcp://", kHttp = "http://", kIgtl = "igtl://", kRos = "ros:";

/// A text that is no address, in the option that it was given to.
struct Given {
  const std::string& text;
  const std::string& option;
  const char* remedy;

  [[noreturn]] void refuse(const std::string& reason) const {
    throw base::InputError({"", 0, option, text, reason, remedy});
  }
};

/// Host and port after `scheme`.
std::pair<std::string, std::uint16_t> parseHostAndPort(const Given& given, std::string_view scheme) {
  if (!given.text.starts_with(scheme)) given.refuse("does not begin with " + std::string(scheme));
  const std::string rest = given.text.substr(scheme.size());
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string::npos) given.refuse("names no port");
  std::string host = rest.substr(0, colon);
  if (host == "localhost") host = "127.0.0.1";
  in_addr parsed{};
  if (inet_pton(AF_INET, host.c_str(), &parsed) != 1) given.refuse("has a host that is no IPv4 address");
  std::uint16_t port = 0;
  const char *begin = rest.data() + colon + 1, *end = rest.data() + rest.size();
  const auto [last, fault] = std::from_chars(begin, end, port);
  if (fault != std::errc() || last != end || begin == end)
    given.refuse("has a port that is no number from 0 to 65535");
  return {std::move(host), port};
}

}  // namespace

bool isAddress(const std::string& text) { return text == "-" || text.starts_with(kTcp) || isRosTopic(text); }

bool isRosTopic(const std::string& text) { return text.starts_with(kRos); }

std::string rosTopicOf(const std::string& text) { return text.substr(kRos.size()); }

Address parseAddress(const std::string& text, const std::string& option) {
  const Given given{text, option,
                    "Give - for standard input, the path of a FIFO, tcp://ADDRESS:PORT, such as "
                    "tcp://127.0.0.1:5555, or ros:/TOPIC"};
  if (text.empty()) given.refuse("is empty");
  if (text == "-") return {};
  if (isRosTopic(text)) return {.kind = Address::Kind::kRos, .path = rosTopicOf(text)};
  if (!text.starts_with(kTcp)) {
    if (text.find("://") != std::string::npos) given.refuse("has a scheme that is not known");
    return {.kind = Address::Kind::kFile, .path = text};
  }
  auto [host, port] = parseHostAndPort(given, kTcp);
  return {.kind = Address::Kind::kTcp, .path = {}, .host = std::move(host), .port = port};
}

bool isIgtlAddress(const std::string& text) { return text.starts_with(kIgtl); }

Address parseIgtlAddress(const std::string& text, const std::string& option) {
  auto [host, port] =
      parseHostAndPort({text, option, "Give igtl://ADDRESS:PORT, such as igtl://127.0.0.1:18944"}, kIgtl);
  return {.kind = Address::Kind::kTcp, .path = {}, .host = std::move(host), .port = port};
}

HttpAddress parseHttpAddress(const std::string& text, const std::string& option) {
  const Given given{text, option, "Give http://ADDRESS:PORT, such as http://127.0.0.1:8081"};
  auto [host, port] = parseHostAndPort(given, kHttp);
  return {std::move(host), port};
}

}  // namespace capstan::live
