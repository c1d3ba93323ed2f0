#include "widgets/figures/export_folder.h"

#include <fstream>
#include <iterator>
#include <string>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/base/yaml.h"

namespace capstan::widgets {

namespace {

namespace fs = std::filesystem;

bool holdsExport(const fs::path& folder, std::string_view mark) {
  std::ifstream file(folder / kIndexFile);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.find(mark) != std::string::npos;
}

}  // namespace

void refuseExport(const fs::path& folder, const std::string& reason, const std::string& remedy) {
  throw base::InputError({folder.string(), 0, {}, {}, reason, remedy});
}

void checkExportFolder(const fs::path& folder, std::string_view mark) {
  std::error_code fault;
  if (fs::exists(folder, fault) && !fs::is_directory(folder, fault))
    refuseExport(folder, "is a file", "Give a folder");
  if (fs::is_directory(folder, fault) && !fs::is_empty(folder, fault) && !holdsExport(folder, mark))
    refuseExport(folder,
                 mark == kFiguresMark ? "is not empty and holds no former figures"
                                      : "is not empty and holds no former report",
                 "Give another folder");
  fs::path there = fs::absolute(folder, fault).lexically_normal();
  if (!there.has_filename()) there = there.parent_path();
  while (!fs::exists(there, fault) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, fault)) refuseExport(there, "is no folder", "Give another folder");
  try {
    base::checkWritable(there / kIndexFile);
  } catch (const base::InputError&) {
    refuseExport(folder, "cannot be written: " + there.string() + " takes no files", "Give another folder");
  }
}

void makeExportFolder(const fs::path& folder, std::string_view mark) {
  checkExportFolder(folder, mark);
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) refuseExport(folder, "cannot be made: " + fault.message(), "Give another folder");
  base::writeTextFile(folder / kIndexFile, std::string(mark) + "<p>This page was not finished.</p>\n");
}

}  // namespace capstan::widgets
