#include "widgets/figures/diagnosis_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/hypotheses/pose_hypotheses.h"
#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/html_parts.h"

namespace capstan::widgets {

namespace {

using diagnosis::Cause;
using diagnosis::Report;
using diagnosis::Verdict;

constexpr const char* kStyle =
    R"(.verdict { border-left: 6px solid #009e73; margin: 1.5em 0; padding: 0.4em 1.2em; }
.verdict.tie, .verdict.unexplained { border-color: #e69f00; }
.verdict.nothing { border-color: var(--line); }
.verdict h2 { margin: 0 0 0.3em; }
.verdict p { font-size: 1.15em; margin: 0.2em 0; }
.cause { border: 1px solid var(--line); border-radius: 6px; margin: 1em 0; padding: 0.4em 1.2em 0.8em; }
.cause h3 { margin: 0.4em 0; }
.size { font-size: 1.15em; font-variant-numeric: tabular-nums; margin: 0.3em 0; }
dl { display: grid; gap: 0.2em 1.2em; grid-template-columns: max-content 1fr; }
dt { color: var(--quiet); }
dd { margin: 0; }
figure { margin: 1em 0; }
summary { cursor: pointer; }
)";

std::string paragraph(const std::string& text, const char* kind = nullptr) {
  return (kind ? fmt::format("<p class=\"{}\">", kind) : std::string("<p>")) + htmlEscaped(text) + "</p>\n";
}

std::string term(const char* name, std::string_view text) {
  if (text.empty()) return {};
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, htmlEscaped(std::string(text)));
}

/// A cancelled diagnosis has no verdict.
std::string verdictHtml(const Report& report) {
  if (report.cancelled)
    return "<div class=\"verdict nothing\"><h2>Cancelled</h2>\n" +
           paragraph("There is no verdict. The page shows the results up to the cancellation.") + "</div>\n";
  std::string html = fmt::format("<div class=\"verdict {}\"><h2>{}</h2>\n", base::nameOf(report.verdict),
                                 htmlEscaped(verdictText(report.verdict)));
  html += paragraph(report.summary);
  if (const std::string tip = diagnosis::tipText(report); !tip.empty()) html += paragraph(tip);
  return html + "</div>\n";
}

/// Description of a cause: joint, size, probability, displacement, gain, and explanation.
std::string causeHtml(const Cause& cause, const char* probability = "Probability") {
  std::string html = "<section class=\"cause\"><h3>" +
                     htmlEscaped(diagnosis::titleAndPlace(cause.effect, cause.joint)) + "</h3>\n";
  std::string size;
  for (const diagnosis::FoundParameter& parameter : cause.parameters)
    size += (size.empty() ? "" : ", ") + diagnosis::shownParameter(cause.effect, parameter);
  html += paragraph(size, "size");
  html += "<dl>\n" + term(probability, fmt::format("{:.0f} %", 100.0 * cause.probability));
  if (!cause.moves.joints.empty()) html += term("Displacement", diagnosis::movesText(cause));
  if (!cause.gain.channel.empty()) html += term("Worth", diagnosis::gainText(cause.gain));
  if (const diagnosis::HypothesisWords* words = diagnosis::wordsOf(cause.effect))
    html += term("What it is", words->what) + term("Equation", words->equation) +
            term("In the model", words->changes) + term("How it shows", words->signature) +
            term("Shown best by", words->experiment) + term("Source", words->source);
  return html + "</dl></section>\n";
}

std::string tieHtml(const diagnosis::Tie& tie) {
  std::string html = "<h2>As good as each other</h2>\n";
  for (const Cause& cause : diagnosis::mostProbableFirst(tie))
    html += causeHtml(cause, "Probability among these");
  if (!tie.separate.empty()) html += "<h3>What would distinguish them</h3>\n" + paragraph(tie.separate);
  return html;
}

/// The causes in their order, each with its tie; consecutive ones without a tie have one heading.
std::string causesHtml(const Report& report) {
  std::string html;
  bool alone = false;
  for (const Cause& cause : report.causes) {
    const diagnosis::Tie* tie = diagnosis::tieOfCause(report, cause);
    if (!tie && !alone) html += "<h2>Causes</h2>\n";
    alone = !tie;
    html += tie ? tieHtml(*tie) : causeHtml(cause);
  }
  return html;
}

std::string nextHtml(const Report& report) {
  return report.next ? paragraph(diagnosis::sentenceOf(*report.next)) : std::string();
}

/// Effects of the model that are no causes, folded.
std::string alsoMeasurableHtml(const Report& report) {
  if (report.also_measurable.empty()) return {};
  std::string html =
      "<details><summary>" + htmlEscaped(diagnosis::alsoMeasurableTitle(report)) + "</summary>\n<ul>\n";
  for (const Cause& cause : report.also_measurable)
    html +=
        "<li>" + htmlEscaped(diagnosis::causeText(cause) + "; " + diagnosis::movesText(cause)) + "</li>\n";
  return html + "</ul></details>\n";
}

/// Table with bars behind the column `name`.
std::string barTable(const base::Table& table, const std::string& name) {
  const auto column = std::ranges::find(table.columns, name, &base::TableColumn::name);
  return htmlTable(table, static_cast<std::size_t>(column - table.columns.begin()));
}

std::string unexplainedHtml(const Report& report) {
  std::string html;
  for (const diagnosis::ResidualProcess& process : report.processes) {
    if (process.end != diagnosis::ProcessEnd::kDone) continue;
    html += paragraph("The residual of " + process.channel + " " + process.words + ".");
    if (!process.variables.empty()) html += htmlTable(diagnosis::processTable(process));
  }
  if (!report.lines.empty()) html += htmlTable(diagnosis::lineTable(report));
  return html.empty() ? html : "<h2>What stays unexplained</h2>\n" + html;
}

std::string links(const std::vector<std::string>& files) {
  std::string html = "<div class=\"files\">";
  for (const std::string& file : files)
    html += "<a href=\"" + htmlAddress(file) + "\">" + htmlEscaped(file) + "</a> ";
  return html + "</div>\n";
}

std::string imageHtml(const DiagnosisImage& image) {
  std::string html = "<figure>";
  for (const std::string& file : image.files)
    if (file.ends_with(".svg"))
      html += "<a href=\"" + htmlAddress(file) + "\"><img src=\"" + htmlAddress(file) +
              "\" loading=\"lazy\" alt=\"" + htmlEscaped(image.caption) + "\"></a>";
  return html + links(image.files) + "</figure>\n";
}

std::string numbersHtml(const Report& report) {
  std::string html;
  if (!report.refit.empty()) html += htmlTable(diagnosis::refitTable(report));
  if (!report.posterior.empty()) html += barTable(diagnosis::posteriorTable(report), "probability");
  if (!report.candidates.empty()) html += barTable(diagnosis::rankingTable(report), "final probability [%]");
  if (!report.filter.empty()) html += htmlTable(diagnosis::filterTable(report));
  return html;
}

std::string endHtml(const Report& report, const std::vector<std::string>& files) {
  std::string html;
  if (!report.notices.empty()) html += "<h2>Notices</h2>\n<ul>\n";
  for (const std::string& notice : report.notices) html += "<li>" + htmlEscaped(notice) + "</li>\n";
  if (!report.notices.empty()) html += "</ul>\n";
  html += "<h2>Files</h2>\n" + links(files);
  std::string stages;
  for (const diagnosis::Stage& stage : report.stages)
    stages += (stages.empty() ? "" : ", ") + fmt::format("{} {:.1f} s", stage.name, stage.seconds);
  if (!stages.empty()) html += paragraph("Computed in: " + stages + ".", "note");
  return html;
}

}  // namespace

std::string verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::kFound:
      return "One cause found";
    case Verdict::kSeveral:
      return "Several causes found";
    case Verdict::kTie:
      return "These recordings cannot decide";
    case Verdict::kNothing:
      return "Nothing material";
    case Verdict::kUnexplained:
      return "Something is there that no hypothesis explains";
  }
  return {};
}

std::string diagnosisPage(const Report& report, const DiagnosisOrigin& origin,
                          const std::vector<DiagnosisChannel>& channels,
                          const std::vector<std::string>& files) {
  std::string recordings;
  for (const std::string& title : report.recordings) recordings += (recordings.empty() ? "" : ", ") + title;
  const std::string title =
      "Where the model of " + (origin.robot.empty() ? "the robot" : origin.robot) + " is wrong";
  std::string html = htmlHead(title, kDiagnosisMark, kStyle) + "<h1>" + htmlEscaped(title) + "</h1>\n";
  html += paragraph(origin.software + (origin.created.empty() ? "" : ", " + origin.created) +
                        ". Recordings: " + recordings + ".",
                    "note");
  html += verdictHtml(report) + causesHtml(report) + alsoMeasurableHtml(report) + unexplainedHtml(report) +
          nextHtml(report);
  html += "<h2>Where the robot model is wrong</h2>\n";
  if (!report.channels.empty()) html += htmlTable(diagnosis::channelTable(report));
  if (!report.explainable.empty()) html += barTable(diagnosis::explainableTable(report), "explained");
  for (const DiagnosisChannel& channel : channels) {
    html += "<h3>" + htmlEscaped(channel.title) + "</h3>\n";
    for (const DiagnosisImage& image : channel.images) html += imageHtml(image);
  }
  html += "<h2>Numbers</h2>\n" + numbersHtml(report) + endHtml(report, files);
  return html + "</body></html>\n";
}

}  // namespace capstan::widgets
