#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "core/live/streams/address.h"

namespace capstan::live {

enum class ReadState {
  kBytes,     ///< bytes were read
  kNothing,   ///< none came within the time
  kOpened,    ///< another program has connected: what follows begins a new stream
  kReplaced,  ///< the same, in place of a program that had to give way
  kClosed,    ///< that program has disconnected; another one may come
  kEnded,     ///< nothing more will come
};

/// Bytes from another program.
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  /// Appends what has come to `out`; waits up to `wait` for it. Throws base::InputError for a fault of the
  /// system.
  virtual ReadState read(std::string& out, std::chrono::milliseconds wait) = 0;
  /// Sends `reason` to the program that is connected, if it can be told, and disconnects it.
  virtual void refuse(const std::string& reason) = 0;
  /// What was read so far was of use: the program that is connected keeps its place.
  virtual void confirm() {}
  /// Whether the stream is a file, whose last line may lack its end. Elsewhere the end of a connection may
  /// cut a line off.
  virtual bool isFile() const { return false; }
  /// The address, with the port in use.
  virtual std::string name() const = 0;
};

/// Opens standard input, a FIFO or file for reading, or a listener (tcp_listener.h). Throws base::InputError
/// that names the address where that fails.
std::unique_ptr<ByteStream> openByteStream(const Address& address);

}  // namespace capstan::live
