#include "app/cli/diagnose_poses.h"

#include <fmt/format.h>

#include <fstream>

#include "app/cli/console.h"
#include "app/cli/recordings.h"
#include "core/recording/csv.h"

namespace capstan::cli {
namespace {

bool isPoses(const std::string& file) {
  if (detectFormat(file) != RecordingFormat::kTable) return false;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);
  return diagnosis::isPoseTable(recording::csvHeaderLine(line));
}

}  // namespace

bool arePoses(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (isPoses(file)) {
      if (files.size() > 1)
        refuseFile(file, "is a table of tip poses among other recordings", "Diagnose it by itself");
      return true;
    }
  return false;
}

diagnosis::PoseReport diagnosePoseTable(const DiagnoseArguments& arguments,
                                        const robot::Description& nominal) {
  if (arguments.skip_start > 0.0)
    refuseOption("--skip-start", fmt::format("{}", arguments.skip_start),
                 "is for recordings that are simulated; poses are compared trajectory by trajectory",
                 "Leave it out");
  if (!arguments.zeros.empty())
    refuseOption("--zeros", arguments.zeros, "is for recordings with joint encoders; poses have none",
                 "Leave it out");
  diagnosis::PoseOptions options;
  if (!arguments.towards.empty())
    options.towards = base::fromName<diagnosis::PoseReference>(arguments.towards);
  options.only = arguments.options.only;
  options.seed = arguments.options.seed;
  base::Progress progress;
  const ProgressLine line(progress);
  return diagnosePoses(diagnosis::readPoseEvidence(arguments.files.front()), nominal, options, &progress);
}

}  // namespace capstan::cli
