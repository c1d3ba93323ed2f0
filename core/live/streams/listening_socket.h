#pragma once

#include <string>

#include "core/live/streams/address.h"
#include "core/live/streams/file_descriptor.h"

namespace capstan::live {

/// A socket that does not block, and its address with the port in use: "tcp://127.0.0.1:5555".
struct ListeningSocket {
  FileDescriptor socket;
  std::string name;
};

/// Listens on a TCP port. Throws base::InputError with the reason where that fails.
ListeningSocket listenOn(const Address& address);

}  // namespace capstan::live
