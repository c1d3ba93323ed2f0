#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"

namespace capstan::widgets {

/// Mark in index.html by which a folder is recognized as an export of figures.
inline constexpr const char* kFiguresMark = "<meta name=\"generator\" content=\"Capstan figures\">";

struct IndexFigure {
  std::string name, caption;
  std::vector<std::string> files;  ///< file names within the folder; the .png is the thumbnail
};

struct IndexTable {
  base::Table table;
  std::vector<std::string> files;
};

/// Files of one subject under one heading.
struct IndexFiles {
  std::string heading;
  std::vector<std::string> files;
};

struct IndexPage {
  std::string title, software;
  bool simulated = false;
  std::vector<IndexFigure> figures;
  std::vector<IndexTable> tables;
  std::vector<IndexFiles> others;
  std::vector<std::string> missing;  ///< figures that could not be drawn, and why
};

/// One HTML page that needs no network, has no scripts or external files, and follows the reader's light or
/// dark scheme. UTF-8.
std::string indexPage(const IndexPage& page);

}  // namespace capstan::widgets
