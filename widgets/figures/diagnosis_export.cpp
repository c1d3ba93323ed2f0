#include "widgets/figures/diagnosis_export.h"

#include <algorithm>

#include "core/base/yaml.h"
#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/report/extended_robot.h"
#include "core/diagnosis/report/report_json.h"
#include "widgets/figures/residual_figure.h"
#include "widgets/figures/save_plot.h"
#include "widgets/figures/signature_figure.h"

namespace capstan::widgets {

namespace {

namespace fs = std::filesystem;
using diagnosis::ChannelReport;
using diagnosis::Report;

/// Vector formats only: the page shows the files directly.
const std::vector<std::string> kEndings = {".svg", ".pdf"};

/// "tip z" as "tip-z".
std::string fileName(std::string channel) {
  for (char& c : channel)
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '-';
  return channel;
}

/// Reduction of the channel's mean square by the causes; without causes, the whole mean square.
double worth(const Report& report, const ChannelReport& channel) {
  const double before = channel.refitted_statistics.rms, after = channel.extended_statistics.rms;
  return report.causes.empty() ? before * before : before * before - after * after;
}

/// One channel per name, in the order in which they are drawn.
std::vector<const ChannelReport*> channelsToDraw(const Report& report) {
  std::vector<const ChannelReport*> chosen;
  for (const ChannelReport& channel : report.channels) {
    const auto same = std::find_if(chosen.begin(), chosen.end(), [&](const ChannelReport* one) {
      return one->refitted.name == channel.refitted.name;
    });
    if (same == chosen.end())
      chosen.push_back(&channel);
    else if (worth(report, channel) > worth(report, **same))
      *same = &channel;
  }
  const std::string first = report.causes.empty() ? std::string() : report.causes.front().gain.channel;
  std::stable_partition(chosen.begin(), chosen.end(),
                        [&](const ChannelReport* one) { return one->refitted.name == first; });
  return chosen;
}

std::string titleOf(const Report& report, const ChannelReport& channel) {
  const auto i = static_cast<std::size_t>(channel.recording);
  return channel.refitted.name + (i < report.recordings.size() ? " in " + report.recordings[i] : "");
}

}  // namespace

std::vector<DiagnosisFigure> figuresOf(const Report& report) {
  std::vector<DiagnosisFigure> figures;
  for (const ChannelReport* channel : channelsToDraw(report)) {
    const std::string name = fileName(channel->refitted.name), title = titleOf(report, *channel);
    figures.push_back({name + "-residual", title, {180.0, 110.0}, [&report, channel] {
                         return std::make_unique<ResidualFigure>(residualData(report, *channel));
                       }});
    const SignatureData signatures = strongestSignatures(report, *channel);
    if (signatures.panels.empty()) continue;
    const double rows = signatures.panels.size() > 2 ? 2.0 : 1.0;
    figures.push_back({name + "-signatures", title, {180.0, 20.0 + 58.0 * rows}, [signatures] {
                         return std::make_unique<SignatureFigure>(signatures);
                       }});
  }
  return figures;
}

DiagnosisExport::DiagnosisExport(Report report, DiagnosisOrigin origin, fs::path folder)
    : report_(std::move(report)), origin_(std::move(origin)), folder_(std::move(folder)) {
  makeExportFolder(folder_, kDiagnosisMark);
  figures_ = figuresOf(report_);
}

double DiagnosisExport::fraction() const {
  return drawn() ? 1.0 : static_cast<double>(next_) / static_cast<double>(figures_.size());
}

void DiagnosisExport::draw() {
  const DiagnosisFigure& next = figures_[next_];
  const auto figure = next.make();
  DiagnosisImage image{figure->caption().toStdString(), {}};
  for (const fs::path& file : exportFigure(*figure, folder_ / next.name, next.size, kEndings)) {
    image.files.push_back(file.filename().string());
    files_.push_back(file);
  }
  if (channels_.empty() || channels_.back().title != next.channel) channels_.push_back({next.channel, {}});
  channels_.back().images.push_back(std::move(image));
  ++next_;
}

std::vector<fs::path> DiagnosisExport::finish() {
  base::writeTextFile(folder_ / "report.json", diagnosis::jsonOf(report_).dump(2) + "\n");
  base::writeTextFile(folder_ / "robot.yaml", diagnosis::extendedRobotText(report_, origin_.software));
  std::vector<std::string> names = {"report.json", "robot.yaml"};
  if (report_.next) {
    names.push_back("next-experiment.csv");
    base::writeTextFile(folder_ / names.back(), diagnosis::trajectoryText(*report_.next));
  }
  base::writeTextFile(folder_ / kIndexFile, diagnosisPage(report_, origin_, channels_, names));
  names.push_back(kIndexFile);
  for (const std::string& file : names) files_.push_back(folder_ / file);
  return files_;
}

std::vector<fs::path> exportDiagnosis(Report report, DiagnosisOrigin origin, const fs::path& folder,
                                      base::Progress* progress) {
  DiagnosisExport all(std::move(report), std::move(origin), folder);
  while (!all.drawn()) {
    if (progress) progress->report(all.fraction(), "drawing " + all.name());
    all.draw();
    if (progress && progress->cancelled()) break;
  }
  return all.finish();
}

}  // namespace capstan::widgets
