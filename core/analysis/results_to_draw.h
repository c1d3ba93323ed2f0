#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/analysis/error_run.h"
#include "core/base/progress.h"
#include "core/experiments/results.h"

/// Results of whatever figures and tables are asked of.
namespace capstan::analysis {

/// `folder`, where it holds results, or those of its folders that do, by name: as `experiment --out` leaves
/// them. Throws base::InputError for a folder without any.
std::vector<std::filesystem::path> resultFolders(const std::filesystem::path& folder);

/// resultsOfErrors() of trackRun(): its name is the file's, and the robot's behind it where `robot` (a file;
/// empty: the recording's own) is assumed. `software`: program and version. Cancelled before it was done:
/// Results::cancelled. Throws base::InputError for files that cannot be used.
experiments::Results resultsOfRecording(const std::filesystem::path& recording,
                                        const std::filesystem::path& robot, const std::string& software,
                                        base::Progress& progress);

/// A running session or a recording as a trial: its errors, their RMS over every sample, and its trajectory.
experiments::Results resultsOfErrors(const ErrorRun& run, const std::string& software);

/// Files begin with the results' names: those that meet a name again get -B, -C, … behind theirs.
void distinguish(std::vector<experiments::Results>& all);

}  // namespace capstan::analysis
