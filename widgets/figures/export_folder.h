#pragma once

#include <filesystem>
#include <string_view>

#include "widgets/figures/index_page.h"

namespace capstan::widgets {

inline constexpr const char* kIndexFile = "index.html";

/// Throws base::InputError where nothing is to be written into `folder`: it is a file, cannot be written, or
/// holds files and no index page with `mark`, by which what stands there is known as of a former run.
void checkExportFolder(const std::filesystem::path& folder, std::string_view mark = kFiguresMark);
/// Makes it, with an index page that has the mark and says that it is not finished: a run that fails can be
/// repeated into the same folder. Throws base::InputError as above.
void makeExportFolder(const std::filesystem::path& folder, std::string_view mark);

}  // namespace capstan::widgets
