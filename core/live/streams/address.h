#pragma once

#include <cstdint>
#include <string>

namespace capstan::live {

/// Where a stream of bytes comes from.
struct Address {
  enum class Kind { kStandardInput, kFile, kTcp, kRos };
  Kind kind = Kind::kStandardInput;
  std::string path;                ///< kFile: a FIFO, a device or a file; kRos: the topic
  std::string host = "127.0.0.1";  ///< kTcp: IPv4 address
  std::uint16_t port = 0;          ///< kTcp; 0: a free one
};

/// Parses "-" (standard input), "tcp://127.0.0.1:5555" (IPv4 address or localhost), "ros:/topic" or the path
/// of a FIFO. Throws base::InputError that names `option` and the text.
Address parseAddress(const std::string& text, const std::string& option);

/// Address to serve images at.
struct HttpAddress {
  std::string host = "127.0.0.1";  ///< IPv4 address
  std::uint16_t port = 0;          ///< 0: a free one
};
/// Parses "http://127.0.0.1:8081" (IPv4 address or localhost). Throws base::InputError that names `option`
/// and the text.
HttpAddress parseHttpAddress(const std::string& text, const std::string& option);

/// Parses "igtl://127.0.0.1:18944" (IPv4 address or localhost), an address to send OpenIGTLink messages at.
/// Throws base::InputError that names `option` and the text.
Address parseIgtlAddress(const std::string& text, const std::string& option);
bool isIgtlAddress(const std::string& text);

/// Whether `text` is the address of a stream rather than the path of a file: "-", "tcp://…" or "ros:/…".
bool isAddress(const std::string& text);
/// Whether `text` is a ROS topic, "ros:/…"; the topic without "ros:".
bool isRosTopic(const std::string& text);
std::string rosTopicOf(const std::string& text);

}  // namespace capstan::live
