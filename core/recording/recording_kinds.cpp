#include "core/recording/recording_kinds.h"

#include "core/recording/session_file.h"
#include "core/table_files/table_kind.h"

namespace capstan::recording {

std::string measuredTableKinds() { return "measured table (" + table_files::tableSuffixes() + ")"; }

std::string recordingKinds() {
  return std::string("session (") + kSessionSuffix + "), " + measuredTableKinds() +
         ", RAVEN-II motor log (.csv) or ROS bag (.bag)";
}

std::string tablePatterns() { return "*" + table_files::tableSuffixes(" *"); }

std::string recordingPatterns() {
  return std::string("*") + kSessionSuffix + " " + tablePatterns() + " *.bag";
}

}  // namespace capstan::recording
