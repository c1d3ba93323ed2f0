#include "app/cli/export_output.h"

#include <fmt/format.h>

namespace capstan::cli {

ExitCode print(const widgets::ExportReport& report, const Output& output) {
  for (const std::string& missing : report.missing) notice(missing);
  output.text(fmt::format("{} figures and {} tables, {} files: {}\n", report.figures, report.tables,
                          report.files.size(), report.files.back().string()));
  nlohmann::json files = nlohmann::json::array();
  for (const std::filesystem::path& file : report.files) files.push_back(file.string());
  output.json({{"figures", report.figures},
               {"tables", report.tables},
               {"files", files},
               {"missing", report.missing},
               {"cancelled", report.cancelled}});
  if (report.cancelled) notice("cancelled: the folder holds the figures that were finished");
  return report.cancelled ? kFailed : kOk;
}

}  // namespace capstan::cli
