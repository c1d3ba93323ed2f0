#include "tests/support/listening_sockets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace capstan::testing {
namespace {

namespace fs = std::filesystem;

/// Numbers of the sockets that the process has open.
std::set<std::string> socketsOf(pid_t process) {
  std::set<std::string> sockets;
  std::error_code gone;
  for (const auto& file : fs::directory_iterator(fmt::format("/proc/{}/fd", process), gone)) {
    const std::string target = fs::read_symlink(file.path(), gone).string();
    if (target.starts_with("socket:[")) sockets.insert(target.substr(8, target.size() - 9));
  }
  return sockets;
}

/// "0100007F:15B3" of /proc/net/tcp in common words; an IPv6 address stays as it is.
std::string wordsOf(const std::string& address) {
  const std::size_t colon = address.find(':');
  const auto port = std::stoul(address.substr(colon + 1), nullptr, 16);
  if (colon != 8) return fmt::format("[{}]:{}", address.substr(0, colon), port);
  const auto host = std::stoul(address.substr(0, colon), nullptr, 16);
  return fmt::format("{}.{}.{}.{}:{}", host & 255, host >> 8 & 255, host >> 16 & 255, host >> 24, port);
}

}  // namespace

std::vector<std::string> listeningSockets(pid_t process) {
  const std::set<std::string> mine = socketsOf(process);
  std::vector<std::string> found;
  constexpr std::array kProtocols = {"tcp", "tcp6", "udp", "udp6"};
  for (const std::string protocol : kProtocols) {
    std::ifstream table("/proc/net/" + protocol);
    std::string line, slot, local, remote, state, skip, inode;
    std::getline(table, line);
    while (std::getline(table, line)) {
      std::istringstream cells(line);
      cells >> slot >> local >> remote >> state;
      for (int k = 0; k < 5; ++k) cells >> skip;
      cells >> inode;
      const bool tcp = protocol.starts_with("tcp");
      constexpr const char* kListening = "0A";
      if (mine.contains(inode) && (!tcp || state == kListening))
        found.push_back(protocol + " " + wordsOf(local));
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace capstan::testing
