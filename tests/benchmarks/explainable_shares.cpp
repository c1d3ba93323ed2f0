// explainable_shares [--data FOLDER] [--threads 2]: how much of what the recorded signals can explain do the
// named effects explain, in each recording of FOLDER? A row per channel, beside the least-squares fit on at
// most seven measured columns and the Gaussian process that it is judged by. What is not in FOLDER is
// skipped.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>

#include "core/base/resource.h"
#include "core/diagnosis/diagnose_files.h"
#include "core/diagnosis/report/shown.h"
#include "core/diagnosis/selection/explainable.h"
#include "tests/support/folders.h"

namespace {

using namespace capstan;
using diagnosis::Explainable;
using Paths = std::vector<std::filesystem::path>;

/// Recordings that are diagnosed together.
struct Group {
  std::string title;
  Paths files;
  std::filesystem::path robot;  ///< empty: a table of tip poses
  double skip_start = 0.0;      ///< [s]
};

/// The .csv files of a folder whose names contain one of `parts`, sorted.
Paths tables(const std::filesystem::path& folder, const std::vector<std::string>& parts) {
  Paths files;
  if (!std::filesystem::exists(folder)) {
    fmt::print("skipped: {} is not on this machine\n", folder.string());
    return files;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const auto is_in_name = [&](const std::string& part) { return name.find(part) != std::string::npos; };
    if (name.ends_with(".csv") && std::ranges::any_of(parts, is_in_name)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

/// Each file for itself.
std::vector<Group> each(const Group& all) {
  std::vector<Group> groups;
  for (const std::filesystem::path& file : all.files)
    groups.push_back({all.title + "/" + file.stem().string(), {file}, all.robot, all.skip_start});
  return groups;
}

std::vector<Group> groupsOf(const std::filesystem::path& data) {
  const std::filesystem::path raven = base::resource("robots/raven2_left.yaml"),
                              robots = test::sourceFile("tests/core/diagnosis/data"),
                              jaw = robots / "jaw.yaml", axis = robots / "emps_axis.yaml";
  const std::vector<std::string> slow{"_0.1Hz", "_0.3Hz"};
  std::vector<Group> groups;
  for (const std::string name : {"davinci-jaw", "davinci-jaw-right"})
    groups.push_back({name, tables(data / name, slow), jaw, 1.0});
  const auto add = [&](const std::string& name, const std::filesystem::path& robot) {
    std::ranges::move(each({name, tables(data / name, {".csv"}), robot}), std::back_inserter(groups));
  };
  add("emps", axis);
  add("raven2-phasespace", {});
  add("plant", raven);
  add("plant-textured", raven);
  std::erase_if(groups, [](const Group& group) { return group.files.empty(); });
  return groups;
}

/// Prints the channels of a group. Returns in how many a regression is materially better.
int printShares(const Group& group, int threads) {
  diagnosis::DiagnosisRequest request;
  for (const std::filesystem::path& file : group.files) request.files.push_back(file.string());
  request.robot = group.robot.string();
  request.evidence.skip_start = group.skip_start;
  request.options.threads = threads;
  request.options.show = request.options.filter = false;
  base::Progress progress;
  const diagnosis::FilesDiagnosis found = diagnosis::diagnoseFiles(request, progress);
  const diagnosis::Report& report = found.report();
  int better = 0;
  for (const Explainable& one : report.explainable) {
    const diagnosis::ShownUnit unit = diagnosis::shownUnit(one.unit);
    const bool falls_short = diagnosis::fallsShort({one}, report.material);
    better += falls_short;
    fmt::print("{:32} {:6} {:>4} {:10.4g} {:10.4g} {:10.4g} {:10.4g} {:10.0f}{}\n", group.title, one.channel,
               unit.unit, unit.scale * one.refitted, unit.scale * one.named, unit.scale * one.linear,
               unit.scale * one.flexible, 100.0 * one.share, falls_short ? "  a regression is better" : "");
  }
  std::fflush(stdout);
  return better;
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = test::dataFolder().string();
  int threads = 2;
  CLI::App app("How much of what the recorded signals can explain do the named effects explain?");
  app.add_option("--data", data, "folder of measured data");
  app.add_option("--threads", threads)->check(CLI::Range(1, 256));
  CLI11_PARSE(app, argc, argv);
  try {
    const std::vector<Group> groups = groupsOf(data);
    fmt::print(
        "RMS residual on held-out data: of the refitted nominal robot, with the named effects, of least\n"
        "squares on at most seven measured columns, and of a Gaussian process. nan: it explains "
        "nothing.\n\n");
    fmt::print("{:32} {:6} {:>4} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "recording", "", "", "refitted",
               "effects", "squares", "process", "share [%]");
    int better = 0;
    for (const Group& group : groups) better += printShares(group, threads);
    fmt::print("\nChannels in which a regression is materially better than the named effects: {}\n", better);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "explainable_shares: %s\n", error.what());
    return 1;
  }
}
