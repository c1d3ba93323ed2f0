#include "tests/support/learning_study/learning_data.h"
#include "tests/support/folders.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <utility>

#include "core/recording/pose_table.h"

namespace capstan::study {

using learning::State;

LearningData readLearningData(const LearningStudyOptions& options) {
  const learning::ScreenReport screen = learning::screenPoses(recording::readPoseTable(options.data));
  const auto target = [&](learning::StreamKind towards) {
    Target one{towards, learning::clockOffsetBetween(screen.motions, towards), {}, {}};
    one.states = learning::statesOf(screen.motions, towards, one.clock_offset.clock_offset);
    one.as_told = learning::statesOf(screen.motions, towards, 0.0);
    return one;
  };
  return {target(learning::StreamKind::kCommand), target(learning::StreamKind::kRobot)};
}

void writeNumbers(const std::filesystem::path& path, const Eigen::MatrixXd& numbers) {
  std::ofstream out(path);
  for (Eigen::Index r = 0; r < numbers.rows(); ++r)
    for (Eigen::Index c = 0; c < numbers.cols(); ++c)
      out << fmt::format("{:.17g}{}", numbers(r, c), c + 1 < numbers.cols() ? "," : "\n");
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

nlohmann::json askSklearn(const std::filesystem::path& folder) {
  const std::string command =
      fmt::format("/usr/bin/python3 '{}' '{}'",
                  test::sourceFile("tests/benchmarks/sklearn_process.py").string(), folder.string());
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, got);
  if (pclose(pipe) != 0) {
    static bool commanded = false;
    if (!std::exchange(commanded, true))
      fmt::print("scikit-learn did not answer; install python3-sklearn for its columns\n");
    return nullptr;
  }
  return nlohmann::json::parse(text);
}

std::filesystem::path folderFor(const LearningStudyOptions& options, const std::string& part) {
  const std::filesystem::path root = options.folder.empty()
                                         ? std::filesystem::temp_directory_path() / "capstan_learning_study"
                                         : std::filesystem::path(options.folder);
  std::filesystem::remove_all(root / part);
  std::filesystem::create_directories(root / part);
  return root / part;
}

PlainScales plainScales(const std::vector<State>& train) {
  learning::CorrectionOptions options;
  options.motion = learning::Motion::kVelocity;
  return {learning::CorrectionModel::rigid(train, options).parts()};
}

PlainTable PlainScales::of(const std::vector<State>& states) const {
  const auto n = static_cast<Eigen::Index>(states.size());
  PlainTable table{{n, parts.features.size()}, {n, 6}, parts.scale};
  for (Eigen::Index k = 0; k < n; ++k) {
    const State& state = states[static_cast<std::size_t>(k)];
    table.features.row(k) =
        (parts.features.of(parts.offset, state) - parts.middle).cwiseQuotient(parts.deviation);
    table.targets.row(k) = parts.features.correction(parts.offset * state.pair.observed, state.pair.commanded)
                               .transpose()
                               .cwiseQuotient(parts.scale);
  }
  return table;
}

}  // namespace capstan::study
