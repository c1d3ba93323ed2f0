#include "core/recording/recording_kinds.h"

#include "core/recording/session_file.h"
#include "core/table_files/table_kind.h"

namespace capstan::recording {

std::string measuredTableKinds() { return "measured table (" + table_files::tableSuffixes() + ")"; }

std::string recordingKinds() {
  return std::string("session (") + kSessionSuffix + "), " + measuredTableKinds() +
         " or RAVEN-II motor log (.csv)";
}

std::string tablePatterns() { return "*" + table_files::tableSuffixes(" *"); }

std::string recordingPatterns() { return std::string("*") + kSessionSuffix + " " + tablePatterns(); }

}  // namespace capstan::recording
