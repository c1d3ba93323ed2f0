#include "widgets/panels/diagnosis/hypothesis_card.h"

#include <fmt/format.h>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

namespace {

QString text(std::string_view words) {
  return QString::fromUtf8(words.data(), static_cast<int>(words.size()));
}

QString paragraph(const QString& head, const QString& words) {
  if (words.isEmpty()) return {};
  const QString begin = head.isEmpty() ? QString() : QStringLiteral("<b>%1</b> ").arg(head.toHtmlEscaped());
  return QStringLiteral("<p style='margin:0 0 5px 0'>") + begin + words.toHtmlEscaped() +
         QStringLiteral("</p>");
}

QString heading(const QString& words) {
  return QStringLiteral("<p style='margin:0 0 5px 0; font-size:11pt; font-weight:600'>") +
         words.toHtmlEscaped() + QStringLiteral("</p>");
}

QString processWords(const diagnosis::ResidualProcess& process) {
  return QObject::tr("%1: %2 (%3 of its variance can be predicted).")
      .arg(text(process.channel), text(process.words), percentText(std::max(process.explained, 0.0)));
}

QString lineWords(const diagnosis::SpectralLine& line, const std::string& unit) {
  return QObject::tr("%1: a vibration at %2 Hz, amplitude %3.")
      .arg(text(line.channel))
      .arg(line.frequency, 0, 'g', 3)
      .arg(text(diagnosis::shownNumber(line.amplitude, 0.0, unit)));
}

std::string unitOf(const diagnosis::Report& report, const std::string& channel) {
  for (const diagnosis::ChannelReport& one : report.channels)
    if (one.refitted.name == channel) return one.refitted.unit;
  return {};
}

}  // namespace

HypothesisCard::HypothesisCard(QWidget* parent) : QTextBrowser(parent) {
  setObjectName("hypothesis");
  setFrameShape(QFrame::NoFrame);
  setOpenLinks(false);
  setAccessibleName(tr("description of the selected cause"));
  setTheme(theme_);
}

void HypothesisCard::setTheme(const Theme& theme) {
  theme_ = theme;
  setStyleSheet("QTextBrowser { padding: 2px 8px; }");
  document()->setDefaultFont(textFont(9.5));
  setHtml(html_);
}

void HypothesisCard::show(const QString& html) {
  if (html == html_) return;
  html_ = html;
  setHtml(html_);
}

void HypothesisCard::showEffect(const std::string& effect, const QString& place, const QString& remark) {
  QString html = heading(place.isEmpty() ? titleOf(effect) : titleOf(effect) + QStringLiteral(", ") + place);
  html += paragraph({}, remark);
  if (const diagnosis::Hypothesis* hypothesis = diagnosis::hypothesisNamed(effect)) {
    const diagnosis::HypothesisWords& words = hypothesis->words;
    html += paragraph({}, text(words.what)) + paragraph(tr("How it shows:"), text(words.signature)) +
            paragraph(tr("What would show it best:"), text(words.experiment)) +
            paragraph(tr("In the model:"), text(words.changes)) +
            paragraph(tr("Equation:"), text(words.equation)) + paragraph(tr("Source:"), text(words.source));
  }
  show(html);
}

void HypothesisCard::showRemains(const diagnosis::Report& report) {
  const bool nothing = report.verdict == diagnosis::Verdict::kNothing && report.also_measurable.empty();
  QString html = heading(report.verdict == diagnosis::Verdict::kUnexplained ? tr("What remains")
                         : nothing                                          ? tr("No cause to show")
                                   : tr("No cause above the tolerance"));
  for (const diagnosis::ResidualProcess& process : report.processes)
    if (process.end == diagnosis::ProcessEnd::kDone) html += paragraph({}, processWords(process));
  for (const diagnosis::SpectralLine& line : report.lines)
    html += paragraph({}, lineWords(line, unitOf(report, line.channel)));
  if (nothing)
    html += paragraph({}, tr("The refitted model explains these recordings as well as a model with any "
                             "hypothesis. The signatures below show the residual."));
  else if (report.verdict == diagnosis::Verdict::kNothing)
    html += paragraph(
        {}, tr("The effects listed as also measurable are in the recordings, and move the joints by "
               "less than the tolerance. With a smaller tolerance they are causes."));
  show(html);
}

}  // namespace capstan::widgets
