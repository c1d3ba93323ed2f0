#include "widgets/figures/session_extras.h"

#include <fmt/format.h>

#include "widgets/figures/save_figure.h"

namespace capstan::widgets {

ExportExtras sessionExtras(const analysis::SessionRecord& record, const JointHistory& history) {
  ExportExtras extras;
  extras.tables = analysis::tablesOf(record);
  extras.settings = record.settings;
  if (history.empty()) return extras;
  std::array<QString, 3> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = QString::fromStdString(record.joint_names[i]);
  const std::string base = record.run.name + "-joints", title = record.run.title;
  extras.drawings.push_back(
      {base, [&history, names, base, title](const std::filesystem::path& folder, const PageOptions& pages) {
         const double begin = history.begin(), end = history.end();
         IndexFigure figure{
             base,
             fmt::format("Joint plots of {}, {:.1f} to {:.1f} s: {}, kinematic, camera, UKF ± 2 σ", title,
                         begin, end, history.referenceName().toStdString()),
             {}};
         for (const auto& file :
              exportJointFigure(history, names, begin, end, folder / base, pages.size.dots()))
           figure.files.push_back(file.filename().string());
         return figure;
       }});
  return extras;
}

}  // namespace capstan::widgets
