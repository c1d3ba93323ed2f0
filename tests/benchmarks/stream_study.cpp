// stream_study [--streams 10000] [--seed 1]: sends mutated streams to a live motor side that listens on a TCP
// port of loopback and tracks what comes. After each of them a robot sends valid rows. Prints what came of
// the streams, and memory and open files before and after. Exit code 1 if the side ended, a fault was not
// named, rows of the robot were not taken, the session's clock went back, or memory grew by more than 8 MB.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "tests/support/attacked_side.h"
#include "tests/support/process_use.h"

namespace {

using namespace capstan::testing;
using capstan::test::residentMegabytes;

std::ptrdiff_t openFiles() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                       std::filesystem::directory_iterator());
}

void print(const char* kind, const MutationCounts& counts) {
  const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf("%-18s %7llu %8llu %8llu %9llu %7llu\n", kind, number(counts.streams), number(counts.refused),
              number(counts.answered), number(counts.rows), number(counts.steps));
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t streams = 10000;
  std::uint64_t seed = 1;
  CLI::App app("What comes of mutated streams at the port of a live motor side");
  app.add_option("--streams", streams, "number of streams");
  app.add_option("--seed", seed);
  CLI11_PARSE(app, argc, argv);
  constexpr double kMostGrowth = 8.0;             // [MB]
  constexpr std::ptrdiff_t kSomeConnections = 2;  // may be open while the files are counted
  const std::size_t warm = std::min<std::size_t>(streams / 10, 500);
  capstan::base::Random random(seed, "mutated streams");
  AttackedSide side;
  double resident = 0.0, most = 0.0;
  std::ptrdiff_t files = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t k = 0; k < streams; ++k) {
    side.send(mutatedStream(k, random));
    if (k + 1 == warm) resident = residentMegabytes(), files = openFiles();
    if (k >= warm && k % 500 == 0) most = std::max(most, residentMegabytes());
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::printf("%-18s %7s %8s %8s %9s %7s\n", "kind", "streams", "refused", "answered", "rows", "steps");
  MutationCounts all;
  for (const auto& [kind, counts] : side.counts()) {
    print(kind.c_str(), counts);
    all.streams += counts.streams, all.refused += counts.refused, all.answered += counts.answered;
    all.rows += counts.rows, all.steps += counts.steps;
  }
  print("all", all);
  most = std::max(most, residentMegabytes());
  std::printf("%.0f s; memory %.1f MB after %zu streams, at most %.1f MB later; open files %td, then %td\n",
              seconds, resident, warm, most, files, openFiles());
  for (std::size_t k = 0; k < std::min<std::size_t>(side.failures().size(), 20); ++k)
    std::printf("FAILURE %s\n", side.failures()[k].c_str());
  std::printf("%zu failures\n", side.failures().size());
  return !side.failures().empty() || most - resident > kMostGrowth || openFiles() > files + kSomeConnections;
}
