#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/analysis/error_run.h"
#include "core/base/progress.h"
#include "core/experiments/results.h"

/// Results for figures and tables, from experiments, recordings and sessions.
namespace capstan::analysis {

/// Folders with results: `folder` itself, or its subfolders with results, by name, as `experiment --out`
/// writes them. Throws base::InputError where there are none.
std::vector<std::filesystem::path> resultFolders(const std::filesystem::path& folder);

/// Results of trackRun() by resultsOfErrors(). Their name is that of the file, followed by that of the robot
/// where `robot` (a file; empty: the recording's own) is given. `software`: program and version. Sets
/// Results::cancelled when cancelled. Throws base::InputError for unusable files.
experiments::Results resultsOfRecording(const std::filesystem::path& recording,
                                        const std::filesystem::path& robot, const std::string& software,
                                        base::Progress& progress);

/// Results of a session or a recording as one trial: its errors, their RMS over all samples, and its
/// trajectory.
experiments::Results resultsOfErrors(const ErrorRun& run, const std::string& software);

/// Makes the names of results, with which their files begin, unique: repeated names get -B, -C, … at their
/// end.
void distinguish(std::vector<experiments::Results>& all);

}  // namespace capstan::analysis
