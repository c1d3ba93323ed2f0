#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/progress.h"
#include "core/recording/measured_table.h"
#include "core/recording/session_file.h"

/// Session files to and from what other programs read. All throw base::InputError for files that cannot be
/// read or written; all are cancellable and leave whole files only.
namespace capstan::recording {

/// Every table of the session as `<table>.csv` in `folder` (created): a header line of column names, SI;
/// frames without their images; `dictionary.csv` has the units. Returns the files.
std::vector<std::filesystem::path> exportCsv(const std::filesystem::path& session,
                                             const std::filesystem::path& folder,
                                             base::Progress* progress = nullptr);
/// The measured table (resources/manual/measured-table.md): one row a motor sample; q from the newest joint
/// sample since the row before, up to the row's own time; p_c from tip samples in the row of their time or
/// the last before it.
MeasuredTable sessionTable(const std::filesystem::path& session);

enum class Existing { kRefuse, kReplace };
/// What becomes of the samples written so far when the disk takes no more.
enum class OnFullDisk { kDiscard, kKeep };
/// A session from a measured table (or any recording that openRecording() opens), sample by sample. A former
/// `session` stays until the new one is whole. A disk that has only its reserve left (DiskSpace), or fails,
/// is a base::InputError that says what became of the samples: kKeep leaves them as a whole session which
/// ends at most 0.2 s before the fault, unless a former session stands there.
void importRecording(tracking::Source& source, const std::filesystem::path& session,
                     const SessionHeader& header, base::Progress* progress = nullptr,
                     Existing existing = Existing::kRefuse, OnFullDisk on_full_disk = OnFullDisk::kDiscard);
/// Frames as `left_000001.png`, `right_000001.png` … in `folder`. Returns the number of images.
std::int64_t exportPng(const std::filesystem::path& session, const std::filesystem::path& folder,
                       base::Progress* progress = nullptr);

struct VideoReport {
  std::int64_t frames = 0;
  std::int64_t other_size =
      0;  ///< frames of another size than the first, which a video cannot hold: excluded
};
/// Both views side by side as a video at the recording's mean frame rate; the suffix chooses the container
/// (.avi, .mkv, .mp4).
VideoReport exportVideo(const std::filesystem::path& session, const std::filesystem::path& video,
                        base::Progress* progress = nullptr);

}  // namespace capstan::recording
