#pragma once

#include <string>

#include "core/live/streams/address.h"
#include "core/live/streams/file_descriptor.h"

namespace capstan::live {

/// Connects to a program that listens on a TCP port, and sends to it.
class TcpSender {
 public:
  /// Throws base::InputError where nothing listens there.
  explicit TcpSender(const Address& address);
  /// Sends all of `bytes`; waits while the receiver is slower. False: the receiver has disconnected.
  bool send(const std::string& bytes);
  /// What the receiver has sent so far, for example the reason of a refusal.
  std::string answer();
  const Address& address() const { return address_; }  ///< of the receiver

 private:
  const Address address_;
  FileDescriptor socket_;
};

}  // namespace capstan::live
