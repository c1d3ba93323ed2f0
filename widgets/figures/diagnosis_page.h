#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/report/report.h"

namespace capstan::widgets {

/// Mark in index.html by which a folder is recognized as a diagnosis.
inline constexpr const char* kDiagnosisMark = "<meta name=\"generator\" content=\"Capstan diagnosis\">";

/// Origin of a diagnosis, besides its recordings.
struct DiagnosisOrigin {
  std::string robot;     ///< name of the nominal robot
  std::string software;  ///< program and version
  std::string created;   ///< time of creation, ISO 8601; empty: not given
};

/// A figure on the page.
struct DiagnosisImage {
  std::string caption;
  std::vector<std::string> files;  ///< file names within the folder; the .svg is shown
};

/// The figures of one channel.
struct DiagnosisChannel {
  std::string title;  ///< for example "q2 in slow.csv"
  std::vector<DiagnosisImage> images;
};

/// The verdict in words: "One cause found".
std::string verdictText(diagnosis::Verdict verdict);

/// One HTML page (html_parts.h): the verdict; its causes with the descriptions of their hypotheses; ties with
/// the motion that would distinguish them; effects that are also measurable; the unexplained residual;
/// figures and numbers of each model's residual, beside what can be explained; the refit; the posterior; the
/// ranking; the errors of the Kalman filter; notices and the files beside the page.
std::string diagnosisPage(const diagnosis::Report& report, const DiagnosisOrigin& origin,
                          const std::vector<DiagnosisChannel>& channels,
                          const std::vector<std::string>& files);

}  // namespace capstan::widgets
