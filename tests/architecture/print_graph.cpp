/// Prints the rooms of core/ and widgets/ layer by layer, highest first, with the rooms that each includes.
#include <fmt/format.h>

#include <cstdio>

#include "tests/architecture/include_graph.h"
#include "tests/support/folders.h"

int main(int argc, char** argv) {
  namespace architecture = capstan::architecture;
  const std::filesystem::path root = argc > 1 ? argv[1] : capstan::test::sourceFile();
  int upwards = 0;
  for (const char* top : {"widgets", "core"}) {
    const auto rooms = architecture::roomsOf(root, top);
    int highest = 0;
    for (const auto& [name, room] : rooms) highest = std::max(highest, room.layer);
    for (int layer = highest; layer >= 0; --layer)
      for (const auto& [name, room] : rooms) {
        if (room.layer != layer) continue;
        std::string arrows;
        for (const auto& [used, lines] : room.arrows) {
          const auto lower = rooms.find(used);
          const bool up = lower != rooms.end() && lower->second.layer >= layer;
          upwards += up;
          arrows += fmt::format(" {}{} ({})", up ? "UPWARDS " : "", used, lines);
        }
        fmt::print("{:>2}  {:<30} {:3} files ->{}\n", layer, name, room.files, arrows);
      }
  }
  fmt::print("{} arrows upwards\n", upwards);
  return upwards == 0 ? 0 : 1;
}
