#pragma once

#include <filesystem>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/table_files/matlab.h"

/// Writing of measured tables and sessions to files of other programs. All functions throw base::InputError
/// for files that cannot be read or written, and leave complete files only.
namespace capstan::recording {

/// Writes a measured table into a file of the kind that the suffix of `path` names, CSV if it names none
/// (table_files::tableKinds()). Units and name in an HDF5 file are those of `robot`.
void writeTable(const MeasuredTable& table, const std::filesystem::path& path,
                const robot::Description& robot,
                table_files::MatlabVersion matlab = table_files::MatlabVersion::k5);

/// Writes a session as HDF5 (resources/manual/file-formats.md): its measured table in the root group, and the
/// rows of its tables of samples, which have their own times, in groups of their names; frames without their
/// images. Returns the measured table. Cancellable.
MeasuredTable exportHdf5(const std::filesystem::path& session, const std::filesystem::path& path,
                         base::Progress* progress = nullptr);

/// The robot that a session contains.
robot::Description sessionRobot(const std::filesystem::path& session);

}  // namespace capstan::recording
