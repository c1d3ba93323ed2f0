#include "core/live/streams/tcp_sender.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace capstan::live {

TcpSender::TcpSender(const Address& address)
    : address_(address), socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(address.port);
  inet_pton(AF_INET, address.host.c_str(), &to.sin_addr);
  const auto setTimeout = [&](timeval timeout) {
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
  };
  setTimeout({1, 0});  // [s] of connecting: a computer that is off does not answer
  if (!socket_.isOpen() || ::connect(socket_.get(), reinterpret_cast<sockaddr*>(&to), sizeof to) != 0)
    throw base::InputError(
        {"",
         0,
         {},
         fmt::format("tcp://{}:{}", address.host, address.port),
         std::string("cannot be connected to: ") + std::strerror(errno == EINPROGRESS ? ETIMEDOUT : errno),
         "Start the program that listens there first"});
  setTimeout({});  // a receiver may take its time
  const int yes = 1;
  ::setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

bool TcpSender::send(const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t count = ::send(socket_.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

std::string TcpSender::answer() {
  std::array<char, 4096> bytes;
  const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  return count > 0 ? std::string(bytes.data(), static_cast<std::size_t>(count)) : std::string();
}

}  // namespace capstan::live
