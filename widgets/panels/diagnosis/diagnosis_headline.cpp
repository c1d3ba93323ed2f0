#include "widgets/panels/diagnosis/diagnosis_headline.h"

#include <QObject>

#include "core/diagnosis/experiment_design/next_experiment.h"
#include "core/diagnosis/report/report_tables.h"
#include "widgets/panels/diagnosis/diagnosis_text.h"

namespace capstan::widgets {

namespace {

using diagnosis::Verdict;

QString markOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNothing:
      return QStringLiteral("○ ");
    case Verdict::kTie:
    case Verdict::kUnexplained:
      return QStringLiteral("◐ ");
    default:
      return QStringLiteral("● ");
  }
}

}  // namespace

Headline verdictOf(const diagnosis::Report& report) {
  QString below = QString::fromStdString(diagnosis::tipText(report));
  if (!below.isEmpty()) below += QLatin1Char('\n');
  below += QString::fromStdString(report.summary);
  for (const diagnosis::Tie& tie : report.ties)
    if (!tie.separate.empty())
      below += QLatin1Char('\n') + QObject::tr("To distinguish %1: %2")
                                       .arg(tiedNames(tie, report.extended).join(QObject::tr(" and ")),
                                            QString::fromStdString(tie.separate));
  if (report.next) below += QLatin1Char('\n') + QString::fromStdString(diagnosis::sentenceOf(*report.next));
  return {markOf(report.verdict) + headlineOf(report), below};
}

Headline searchingHeadline() {
  return {QObject::tr("Searching for errors of the robot model…"),
          QObject::tr("The longer the recordings, the longer it takes; Esc cancels it.")};
}

Headline emptyHeadline() {
  return {QObject::tr("Where is the robot model wrong?"),
          QObject::tr(
              "Choose one or more recordings of the moving robot: 20 s with all joints in motion, fast and "
              "slow, back and forth; or one table of tip poses. Diagnosis names the effects that the model "
              "lacks, and how much the error falls with each.")};
}

Headline toleranceHeadline() {
  return {QObject::tr("The tolerance cannot be read"), QObject::tr("Correct it above.")};
}

Headline readyHeadline() { return {QObject::tr("Ready to diagnose"), QObject::tr("Press Diagnose (F5).")}; }

}  // namespace capstan::widgets
