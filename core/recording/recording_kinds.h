#pragma once

#include <string>

/// Lists of the kinds of files that hold recordings, for help texts, errors and file dialogs.
namespace capstan::recording {

/// "measured table (.csv, .jsonl, .h5, .hdf5, .mat)"
std::string measuredTableKinds();
/// "session (.capstan), measured table (.csv, …), RAVEN-II motor log (.csv) or ROS bag (.bag)"
std::string recordingKinds();
/// "*.csv *.jsonl *.h5 *.hdf5 *.mat"
std::string tablePatterns();
/// The same with "*.capstan" before and "*.bag" behind.
std::string recordingPatterns();

}  // namespace capstan::recording
