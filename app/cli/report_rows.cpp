#include "app/cli/report_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <sstream>

#include "app/cli/html_text.h"
#include "app/cli/track_output.h"
#include "core/identification/estimate_text.h"
#include "core/identification/live_text.h"
#include "core/tracking/transmission_text.h"

namespace capstan::cli {
namespace {

using experiments::IdentifyAndTrack;
using identification::Estimate;
using tracking::TrackReport;

constexpr const char* kLegend = "RMS error as kinematic / camera / UKF";

double forPeople(const tracking::JointRms& rms, int joint) {
  return tracking::forPeople(rms.value()(joint), joint);
}

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3f}", value); }

std::vector<std::string> cellsOf(const TrackReport& report) {
  std::vector<std::string> cells;
  for (int joint = 0; joint < 3; ++joint)
    cells.push_back(number(forPeople(report.errors.kinematic(), joint)) + " / " +
                    number(forPeople(report.errors.camera(), joint)) + " / " +
                    number(forPeople(report.errors.ukf(), joint)));
  return cells;
}

/// Sentence that compares the filter with the better of its two inputs, joint by joint.
std::string comparison(const TrackReport& report, bool own_kinematics) {
  if (own_kinematics)
    return "The reference is the robot's own kinematics: it cannot show which estimate is right.";
  if (report.errors.ukf().count() == 0)
    return "The recording holds no joint encoders: there are no errors to compare.";
  std::vector<std::string> worse;
  for (int joint = 0; joint < 3; ++joint) {
    const auto compare = [&](const tracking::JointRms& ukf, const tracking::JointRms& input,
                             const char* name) {
      if (forPeople(ukf, joint) > forPeople(input, joint))  // false without an input
        worse.push_back(fmt::format("q{} ({:.3f} {}, {} {:.3f})", joint + 1, forPeople(ukf, joint),
                                    tracking::kJointUnits[static_cast<std::size_t>(joint)], name,
                                    forPeople(input, joint)));
    };
    compare(report.errors.ukf(), report.errors.kinematic(), "kinematics alone");
    compare(report.errors.ukfSeen(), report.errors.camera(), "the camera alone where it saw the tip");
  }
  return worse.empty()
             ? fmt::format("The filter is better than kinematics on every joint{}.",
                           report.errors.camera().count() > 0
                               ? ", and than the camera on every joint while it sees the tip"
                               : "")
             : fmt::format("The filter is worse than one of its inputs on {}.", fmt::join(worse, ", "));
}

/// Sentence on the NIS test of the filter's consistency, which needs no joint encoders.
std::string nisSentence(const TrackReport& report) {
  const auto nis = nisVerdict(report);
  if (!nis) return "No camera sample was accepted: there is no NIS.";
  std::string text = fmt::format("NIS / 3 is {:.3g}, its 95 % band {:.3f} to {:.3f}: {}", nis->mean,
                                 nis->band.low, nis->band.high, nis->text());
  const std::string advice = nis->advice();
  return text + (advice.empty() ? "." : ", " + advice + ".");
}

/// Sentence on the transmission errors that the augmented filter carries, with remedies; empty: none.
std::string carriedSentence(const TrackReport& report) {
  const std::vector<std::string> lines = tracking::linesOf(report.transmission);
  if (lines.empty()) return {};
  return fmt::format(" The filter found with the camera: {}. {}", fmt::join(lines, "; "),
                     fmt::join(tracking::remediesOf(report.transmission), " "));
}

/// Identified values in the format of the window: with as many decimals as σ justifies.
std::string found(const std::vector<Estimate>& estimates) {
  std::vector<std::string> values;
  for (const Estimate& estimate : estimates) {
    if (!estimate.seen) continue;
    const identification::LiveRow row = identification::rowOf(estimate, nullptr, estimate.percent());
    values.push_back(fmt::format("{} {} {} {} ({})", row.name, row.value, row.sigma, row.unit, row.change));
  }
  return values.empty() ? "nothing" : fmt::format("{}", fmt::join(values, ", "));
}

ReportRow foundRow(const IdentifyAndTrack& after) {
  ReportRow row{"2 identified", {}, "nothing", {}};
  const bool any = after.identified && after.identified->choice.method;
  if (any) row.words = found(after.identified->estimates());
  if (after.cancelled && !after.tracked) {
    row.sentence = "Cancelled before the end.";
  } else if (!after.fault.empty()) {
    row.sentence = fmt::format("Nothing could be identified: {}.", after.fault);
  } else if (any) {
    const std::string kept = identification::keptText(after.identified->estimates());
    row.sentence = fmt::format(
        "From {:.0f} s of motors and cameras alone, by the {} method; in percent: change from the nominal "
        "value. {}",
        after.duration, base::nameOf(*after.identified->choice.method),
        kept.empty() ? "Every parameter is observable." : kept);
  }
  return row;
}

std::string broken(const std::string& text, const std::string& indent) {
  constexpr std::size_t kWidth = 100;
  std::string lines, line;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > kWidth) {
      lines += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + indent + line + "\n";
}

}  // namespace

std::vector<ReportRow> reportRows(const TrackReport& nominal, const IdentifyAndTrack& after,
                                  bool own_kinematics) {
  std::vector<ReportRow> rows = {
      {"1 nominal",
       cellsOf(nominal),
       {},
       nisSentence(nominal) + carriedSentence(nominal) + " " + comparison(nominal, own_kinematics)},
      foundRow(after)};
  if (after.tracked)
    rows.push_back({"3 tracked again",
                    cellsOf(*after.tracked),
                    {},
                    nisSentence(*after.tracked) + carriedSentence(*after.tracked) + " " +
                        comparison(*after.tracked, own_kinematics)});
  return rows;
}

std::string textOf(const std::vector<ReportRow>& rows) {
  const std::string indent(16, ' ');
  std::string text = fmt::format("\nFrom nominal to identified constants, {}\n", kLegend);
  text += fmt::format("{:<16}{:<26}{:<26}{}\n", "", "q1 [deg]", "q2 [deg]", "q3 [mm]");
  for (const ReportRow& row : rows) {
    if (row.cells.empty()) {
      std::string words = broken(row.words, indent);
      text += fmt::format("{:<16}", row.name) + words.substr(indent.size());
    } else {
      text += fmt::format("{:<16}{:<26}{:<26}{}\n", row.name, row.cells[0], row.cells[1], row.cells[2]);
    }
    text += broken(row.sentence, indent);
  }
  return text;
}

std::string htmlOf(const std::vector<ReportRow>& rows) {
  std::string html = fmt::format(
      "<h2>From nominal to identified constants</h2>\n<p>{}.</p>\n<table class=\"rows\">\n"
      "<tr><th></th><th>q1 [deg]</th><th>q2 [deg]</th><th>q3 [mm]</th></tr>\n",
      kLegend);
  for (const ReportRow& row : rows) {
    html += fmt::format("<tr><th rowspan=\"2\">{}</th>", escaped(row.name));
    if (row.cells.empty())
      html += fmt::format("<td class=\"words\" colspan=\"3\">{}</td>", escaped(row.words));
    for (const std::string& cell : row.cells) html += fmt::format("<td>{}</td>", escaped(cell));
    html += fmt::format("</tr>\n<tr><td class=\"words\" colspan=\"3\">{}</td></tr>\n", escaped(row.sentence));
  }
  return html + "</table>\n";
}

nlohmann::json jsonOf(const IdentifyAndTrack& after, const tracking::SourceInfo& info) {
  nlohmann::json document = {{"fault", after.fault}, {"cancelled", after.cancelled}};
  document["tracked"] = after.tracked ? jsonOf(*after.tracked, info) : nlohmann::json();
  document["parameters"] = nlohmann::json::array();
  if (!after.identified || !after.identified->choice.method) return document;
  document["method"] = base::nameOf(*after.identified->choice.method);
  for (const Estimate& estimate : after.identified->estimates())
    document["parameters"].push_back({{"name", estimate.parameter.name()},
                                      {"nominal", estimate.parameter.nominal},
                                      {"value", estimate.value()},
                                      {"sigma", estimate.valueSigma()},
                                      {"seen", estimate.seen}});
  return document;
}

}  // namespace capstan::cli
