#include "core/learning/model/correction_source.h"

#include "core/base/checksum.h"

namespace capstan::learning {

CorrectionSource correctionSource(const std::vector<std::string>& tables, learning::StreamKind towards,
                                  const learning::LearningReport& report, const std::string& software,
                                  CorrectionSource before) {
  CorrectionSource source = std::move(before);
  source.files.insert(source.files.end(), tables.begin(), tables.end());
  for (const std::string& table : tables) source.checksums.push_back(base::checksumOfFile(table));
  source.towards = towards;
  source.clock_offset = report.prepared.removed;
  source.states += report.cleaning.kept();
  source.rejected += report.cleaning.reason.size() - report.cleaning.kept();
  source.software = software;
  return source;
}

}  // namespace capstan::learning
