#pragma once

#include "core/live/streams/byte_stream.h"
#include "core/live/streams/file_descriptor.h"

namespace capstan::live {

/// Listens on a TCP port and reads from one program at a time; a second one gets an error and is
/// disconnected. A program without a valid row for kPatience (confirm()) is replaced when another one
/// connects. Before its first valid row, the other one waits for that time.
class TcpListener final : public ByteStream {
 public:
  /// Throws base::InputError with the reason where the port cannot be listened on.
  explicit TcpListener(const Address& address);

  ReadState read(std::string& out, std::chrono::milliseconds wait) override;
  void refuse(const std::string& reason) override;
  void confirm() override { useful_at_ = Clock::now(), useful_ = true; }
  std::string name() const override { return name_; }

  static constexpr std::chrono::seconds kPatience{2};

 private:
  using Clock = std::chrono::steady_clock;

  bool listens() const;
  bool mustGiveWay() const { return Clock::now() - useful_at_ >= kPatience; }
  ReadState accept();

  FileDescriptor listener_, client_;
  std::string name_;
  Clock::time_point useful_at_;  ///< when the client has connected, or was confirmed last
  bool useful_ = false;          ///< it was confirmed
};

}  // namespace capstan::live
