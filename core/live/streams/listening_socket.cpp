#include "core/live/streams/listening_socket.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace capstan::live {

ListeningSocket listenOn(const Address& address) {
  ListeningSocket listening{FileDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
                            fmt::format("tcp://{}:{}", address.host, address.port)};
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(address.port);
  inet_pton(AF_INET, address.host.c_str(), &at.sin_addr);
  socklen_t size = sizeof at;
  const int yes = 1, socket = listening.socket.get();
  auto* const plain = reinterpret_cast<sockaddr*>(&at);
  if (!listening.socket.isOpen() || ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(socket, plain, size) != 0 || ::listen(socket, 4) != 0 ||
      ::getsockname(socket, plain, &size) != 0) {
    const int why = errno;
    throw base::InputError(
        {"",
         0,
         {},
         listening.name,
         std::string("cannot be listened on: ") + std::strerror(why),
         why == EADDRNOTAVAIL
             ? "Give an address of this computer: 127.0.0.1 for its own programs, 0.0.0.0 for all"
             : "Choose another port, or end the program or the live session that has it"});
  }
  listening.name = fmt::format("tcp://{}:{}", address.host, ntohs(at.sin_port));
  return listening;
}

}  // namespace capstan::live
