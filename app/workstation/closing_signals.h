#pragma once

#include <QCoreApplication>

namespace capstan::workstation {

/// Makes SIGTERM, SIGINT and SIGHUP close all windows, as a person would: the recording is finished, settings
/// are saved, and the monitor's shared memory is removed. The second signal ends the process at once. Throws
/// std::system_error if the process has no more file descriptors.
void closeOnSignals(QCoreApplication& application);

}  // namespace capstan::workstation
