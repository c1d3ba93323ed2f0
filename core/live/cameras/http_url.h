#pragma once

#include <string>

namespace capstan::live {

/// Parts of the address of a network camera.
struct HttpUrl {
  std::string user, password;  ///< empty: none
  std::string host;
  int port = 80;
  std::string path;  ///< begins with '/'; with what follows '?'
};

/// Parses "http://[USER:PASSWORD@]HOST[:PORT][/PATH]". HOST may be an IPv6 address in brackets. Characters of
/// USER and PASSWORD may be written as %XX; '/', '?' and '%' have to be, and ':' in USER. Throws
/// base::InputError that names the address.
HttpUrl parseHttpUrl(const std::string& address);

/// `address` ("rtsp://USER:PASSWORD@HOST/PATH") without user and password, for messages and recordings.
std::string withoutPassword(const std::string& address);

/// Whether `address` is one of those: "http://…".
bool isHttpAddress(const std::string& address);

}  // namespace capstan::live
