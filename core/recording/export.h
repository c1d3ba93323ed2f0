#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/measured_table.h"
#include "core/recording/session_file.h"

/// Export of session files to other formats, and import from them. All functions throw base::InputError for
/// files that cannot be read or written. All are cancellable and leave complete files only.
namespace capstan::recording {

/// Writes every table of the session to `<table>.csv` in `folder` (created): a header line of column names,
/// SI units; frames without their images; `dictionary.csv` has the units. Returns the files.
std::vector<std::filesystem::path> exportCsv(const std::filesystem::path& session,
                                             const std::filesystem::path& folder,
                                             base::Progress* progress = nullptr);
/// Measured table of the session (resources/manual/measured-table.md): one row per motor sample. q is that of
/// the newest joint sample after the previous row and up to the row's own time. p_c of a tip sample is in the
/// last row at or before its time.
MeasuredTable sessionTable(const std::filesystem::path& session);

enum class Existing { kRefuse, kReplace };
/// Treatment of the samples written so far when the disk is full.
enum class OnFullDisk { kDiscard, kKeep };
/// Writes a session from a measured table (or any recording that openRecording() opens), sample by sample. A
/// former `session` stays until the new one is complete. If the disk fails or has only its reserve left
/// (DiskSpace), throws a base::InputError that reports what happened to the samples. kKeep leaves them as a
/// complete session that ends at most 0.2 s before the fault, unless a former session exists there.
void importRecording(tracking::Source& source, const std::filesystem::path& session,
                     const SessionHeader& header, base::Progress* progress = nullptr,
                     Existing existing = Existing::kRefuse, OnFullDisk on_full_disk = OnFullDisk::kDiscard);
/// Writes frames as `left_000001.png`, `right_000001.png` … to `folder`. Returns the number of images.
std::int64_t exportPng(const std::filesystem::path& session, const std::filesystem::path& folder,
                       base::Progress* progress = nullptr);

struct VideoReport {
  std::int64_t frames = 0;
  std::int64_t other_size = 0;  ///< number of frames excluded because their size differs from the first
  double begin = 0.0;           ///< exposure of the first frame after the session's first sample [s]
};
/// Writes both views side by side as a video at the mean rate of the frames' exposures; the suffix selects
/// the container (.avi, .mkv, .mp4).
VideoReport exportVideo(const std::filesystem::path& session, const std::filesystem::path& video,
                        base::Progress* progress = nullptr);

}  // namespace capstan::recording
