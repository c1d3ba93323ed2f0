#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"

namespace capstan::widgets {

/// What index.html of every folder of figures holds, by which such a folder is known.
inline constexpr const char* kFiguresMark = "<meta name=\"generator\" content=\"Capstan figures\">";

struct IndexFigure {
  std::string name, caption;
  std::vector<std::string> files;  ///< names within the folder; the .png is the thumbnail
};

struct IndexTable {
  base::Table table;
  std::vector<std::string> files;
};

struct IndexPage {
  std::string title, software;
  bool simulated = false;
  std::vector<IndexFigure> figures;
  std::vector<IndexTable> tables;
  std::vector<std::string> missing;  ///< what could not be drawn, and why
};

/// One page that opens without a network: no scripts, nothing from elsewhere, light or dark as the reader's
/// screen is. UTF-8.
std::string indexPage(const IndexPage& page);

}  // namespace capstan::widgets
