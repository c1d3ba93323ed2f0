#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/diagnose_run.h"
#include "core/diagnosis/poses/pose_diagnosis.h"

namespace capstan::cli {

/// Is it a table of tip poses (diagnosis::isPoseTable)? base::InputError for several files of which one is:
/// they are diagnosed one at a time.
bool arePoses(const std::vector<std::string>& files);

/// Reads and diagnoses the one table of `arguments`. base::InputError for options that say nothing of poses.
diagnosis::PoseReport diagnosePoseTable(const DiagnoseArguments& arguments,
                                        const robot::Description& nominal);

}  // namespace capstan::cli
