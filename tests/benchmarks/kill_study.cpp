// kill_study [KILLS] [FOLDER]: records at the real rate in child processes, kills them at random instants,
// and says what each file holds. Exit code 1 when a file does not open or lost something older than 0.5 s.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/core/recording/recording_child.h"

int main(int argc, char** argv) {
  using namespace capstan::recording;
  const int kills = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::filesystem::path root = argc > 2 ? argv[2] : std::filesystem::temp_directory_path();
  std::filesystem::create_directories(root);
  capstan::base::Random random(1);
  int unopened = 0, torn = 0, late = 0;
  double oldest = 0.0, offered = 0.0, megabytes = 0.0;
  std::vector<double> ages;
  for (int i = 0; i < kills; ++i) {
    const auto path =
        root / ("capstan_kill_" + std::to_string(getpid()) + "_" + std::to_string(i) + ".capstan");
    const auto outcome = testing::recordAndKill(path, random.uniform(0.3, 2.0));
    unopened += !outcome.opened;
    torn += !outcome.intact;
    late += outcome.lost_late > 0;
    oldest = std::max(oldest, outcome.oldest_lost);
    ages.push_back(outcome.oldest_lost);
    offered += outcome.offered;
    megabytes += static_cast<double>(outcome.bytes) * 1e-6;
    if (!outcome.error.empty()) std::printf("kill %d: %s\n", i, outcome.error.c_str());
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path.string() + suffix);
  }
  std::sort(ages.begin(), ages.end());
  std::printf("%d kills at 2 x 15 frames/s + 3 x 1 kHz rows; %.0f samples offered, %.0f MB\n", kills, offered,
              megabytes);
  std::printf("files that did not open: %d; with gaps or damaged images: %d\n", unopened, torn);
  std::printf("files that lost a sample older than 0.5 s: %d\n", late);
  std::printf("age of the oldest lost sample: median %.3f s, worst %.3f s\n", ages[ages.size() / 2], oldest);
  return unopened + torn + late > 0;
}
