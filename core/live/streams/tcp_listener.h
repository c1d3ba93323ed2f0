#pragma once

#include "core/live/streams/byte_stream.h"
#include "core/live/streams/file_descriptor.h"

namespace capstan::live {

/// Listens on a TCP port and reads from one program at a time; a second one is told so and disconnected.
class TcpListener final : public ByteStream {
 public:
  /// Throws base::InputError with the reason where the port cannot be listened on.
  explicit TcpListener(const Address& address);

  ReadState read(std::string& out, std::chrono::milliseconds wait) override;
  void refuse(const std::string& reason) override;
  std::string name() const override { return name_; }

 private:
  ReadState accept();

  FileDescriptor listener_, client_;
  std::string name_;
};

}  // namespace capstan::live
