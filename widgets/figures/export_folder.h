#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "widgets/figures/index_page.h"

namespace capstan::widgets {

inline constexpr const char* kIndexFile = "index.html";

/// Checks that an export may write into `folder`. Throws base::InputError if it is a file, cannot be written,
/// or holds files but no index page with `mark`, which identifies the folder of an earlier run.
void checkExportFolder(const std::filesystem::path& folder, std::string_view mark = kFiguresMark);
/// Creates the folder with an index page that has the mark and says that the run is not finished, so that a
/// failed run can be repeated into the same folder. Throws base::InputError as checkExportFolder().
void makeExportFolder(const std::filesystem::path& folder, std::string_view mark);

/// Throws base::InputError about the folder of an export.
[[noreturn]] void refuseExport(const std::filesystem::path& folder, const std::string& reason,
                               const std::string& remedy);

}  // namespace capstan::widgets
