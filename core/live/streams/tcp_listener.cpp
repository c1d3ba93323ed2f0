#include "core/live/streams/tcp_listener.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

#include "core/live/streams/listening_socket.h"

namespace capstan::live {
namespace {

constexpr std::size_t kChunk = 1U << 16;

void send(int client, const std::string& line) {
  (void)::send(client, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

}  // namespace

TcpListener::TcpListener(const Address& address) {
  ListeningSocket listening = listenOn(address);
  listener_ = std::move(listening.socket);
  name_ = std::move(listening.name);
}

/// Whether a newcomer gets an answer now, rather than when the time of the one that is connected is over.
bool TcpListener::listens() const { return !client_.isOpen() || useful_ || mustGiveWay(); }

ReadState TcpListener::read(std::string& out, std::chrono::milliseconds wait) {
  std::array<pollfd, 2> polls = {pollfd{listens() ? listener_.get() : -1, POLLIN, 0},
                                 pollfd{client_.get(), POLLIN, 0}};
  if (::poll(polls.data(), client_.isOpen() ? 2 : 1, static_cast<int>(wait.count())) <= 0)
    return ReadState::kNothing;
  if (client_.isOpen() && polls[1].revents != 0) {
    const std::size_t before = out.size();
    out.resize(before + kChunk);
    const ssize_t count = ::recv(client_.get(), out.data() + before, kChunk, MSG_DONTWAIT);
    out.resize(before + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count > 0) return ReadState::kBytes;
    if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
      client_.close();
      return ReadState::kClosed;
    }
  }
  return polls[0].revents != 0 ? accept() : ReadState::kNothing;
}

ReadState TcpListener::accept() {
  FileDescriptor caller(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!caller.isOpen()) return ReadState::kNothing;
  const bool replaces = client_.isOpen();
  if (replaces && !mustGiveWay()) {
    send(caller.get(), fmt::format("error: {}: another program sends its rows here. End it first\n", name_));
    return ReadState::kNothing;
  }
  if (replaces) refuse(fmt::format("no valid row for {} s, and another program has come", kPatience.count()));
  client_ = std::move(caller);
  useful_at_ = Clock::now(), useful_ = false;
  return replaces ? ReadState::kReplaced : ReadState::kOpened;
}

void TcpListener::refuse(const std::string& reason) {
  if (!client_.isOpen()) return;
  send(client_.get(), "error: " + reason + "\n");
  ::shutdown(client_.get(), SHUT_WR);
  // Reading what the program has already sent lets the reason reach it: closing with unread bytes resets the
  // connection.
  std::array<char, 4096> rest;
  while (::recv(client_.get(), rest.data(), rest.size(), MSG_DONTWAIT) > 0) {
  }
  client_.close();
}

}  // namespace capstan::live
