#pragma once

#include <QString>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// Headline of the diagnosis panel, and the sentences below it.
struct Headline {
  QString head, below;
};

/// Verdict with a mark that distinguishes it in grey print too; below it the tip displacement, the summary,
/// and for ties the motion that would distinguish the causes.
Headline verdictOf(const diagnosis::Report& report);
Headline searchingHeadline();
Headline emptyHeadline();      ///< no recording is chosen
Headline toleranceHeadline();  ///< the tolerance has an error
Headline readyHeadline();

}  // namespace capstan::widgets
