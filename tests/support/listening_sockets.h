#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace capstan::testing {

/// Addresses at which a process can be reached from a network, as in "tcp 127.0.0.1:5555", in order: TCP
/// sockets that listen and UDP sockets that are bound, IPv4 and IPv6 (/proc). Sockets of its X connection are
/// none: they are local files.
std::vector<std::string> listeningSockets(pid_t process);

}  // namespace capstan::testing
