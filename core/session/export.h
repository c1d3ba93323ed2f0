#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/progress.h"
#include "core/session/measured_table.h"
#include "core/session/session_file.h"

/// Session files to and from what other programs read. All throw base::InputError for files that cannot be
/// read or written; all are cancellable and leave whole files only.
namespace capstan::session {

/// Every table of the session as `<table>.csv` in `folder` (created): a header line of column names, SI;
/// frames without their images; `dictionary.csv` has the units. Returns the files.
std::vector<std::filesystem::path> exportCsv(const std::filesystem::path& session,
                                             const std::filesystem::path& folder,
                                             base::Progress* progress = nullptr);
/// The measured table of model.md §6: one row a motor sample, q from the joint sample of the same or the last
/// time before it, p_c from tip samples at their own time's row.
MeasuredTable sessionTable(const std::filesystem::path& session);
/// A session from a measured table (or any recording that openRecording() opens), sample by sample.
void importRecording(Source& source, const std::filesystem::path& session, const SessionHeader& header,
                     base::Progress* progress = nullptr);
/// Frames as `left_000001.png`, `right_000001.png` … in `folder`. Returns the number of images.
std::int64_t exportPng(const std::filesystem::path& session, const std::filesystem::path& folder,
                       base::Progress* progress = nullptr);
/// Both views side by side as a video at the recording's mean frame rate; the suffix chooses the container
/// (.avi, .mkv, .mp4). Returns the number of frames.
std::int64_t exportVideo(const std::filesystem::path& session, const std::filesystem::path& video,
                         base::Progress* progress = nullptr);

}  // namespace capstan::session
