#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// What index.html of every diagnosis holds, by which such a folder is known.
inline constexpr const char* kDiagnosisMark = "<meta name=\"generator\" content=\"Capstan diagnosis\">";

/// Where a diagnosis comes from, besides its recordings.
struct DiagnosisOrigin {
  std::string robot;     ///< name of the nominal robot
  std::string software;  ///< program and version
  std::string created;   ///< when, ISO 8601; empty: not said
};

/// A drawing on the page.
struct DiagnosisImage {
  std::string caption;
  std::vector<std::string> files;  ///< within the folder; the .svg is shown
};

/// The pictures of one channel.
struct DiagnosisChannel {
  std::string title;  ///< "q2 in slow.csv"
  std::vector<DiagnosisImage> images;
};

/// The verdict in words: "One cause found".
std::string verdictText(diagnosis::Verdict verdict);

/// One page (html_parts.h): the verdict; its causes with the descriptions of their hypotheses; ties with the
/// motion that would distinguish them; what stays unexplained; what each model gets wrong, drawn and in
/// numbers; the refit; the ranking; what the filter gains; notices and the files beside the page.
std::string diagnosisPage(const diagnosis::Report& report, const DiagnosisOrigin& origin,
                          const std::vector<DiagnosisChannel>& channels,
                          const std::vector<std::string>& files);

}  // namespace capstan::widgets
