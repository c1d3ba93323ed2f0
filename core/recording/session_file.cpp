#include "core/recording/session_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/software.h"
#include "core/base/yaml.h"
#include "core/recording/row_counts.h"
#include "core/recording/session_reader.h"

namespace capstan::recording {
namespace {

std::uint64_t sizeOf(const std::filesystem::path& path) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(path, fault);
  return fault ? 0 : size;
}

/// Throws SqliteError if rows have vanished since the recording ended.
void countRows(Database& database, SessionSummary& summary) {
  const RowCounts counts = rowCounts(database);
  const std::string& written = summary.header.rows;
  if (!written.empty() && written != textOf(counts))
    throw SqliteError(SQLITE_CORRUPT, fmt::format("it has {} rows, of {}", textOf(counts), written));
  summary.motor = counts[kMotorTable], summary.joint = counts[kJointTable], summary.tip = counts[kTipTable];
  summary.frames = counts[kFrameTable], summary.estimates = counts[kEstimateTable];
  summary.events = counts[kEventTable];
}

/// Times of the first and the last sample.
void findSpan(Database& database, SessionSummary& summary) {
  bool any = false;
  for (int which = 0; which <= kFrameTable; ++which)
    for (const char* direction : {"ASC", "DESC"}) {
      Statement row = rowsOf(database, table(static_cast<SampleTable>(which)),
                             fmt::format("ORDER BY seq {} LIMIT 1", direction));
      if (!row.step()) continue;
      const double t = row.real(1);
      summary.first_t = any ? std::min(summary.first_t, t) : t;
      summary.last_t = any ? std::max(summary.last_t, t) : t;
      any = true;
    }
}

}  // namespace

SessionHeader headerOf(const tracking::SourceInfo& source, std::string created) {
  SessionHeader header;
  header.title = source.title;
  header.created = std::move(created);
  header.software = "capstan " + base::version();
  header.robot = base::writeYaml(source.robot);
  if (source.rig) {
    auto cameras = vision::formatStereoRig(*source.rig);
    header.camera_left = std::move(cameras[0]);
    header.camera_right = std::move(cameras[1]);
  }
  header.truth = source.truth;
  header.marker = source.marker;
  header.tracking = source.tracking;
  header.base_from_camera = source.base_from_camera;
  header.reference = source.reference;
  header.own_kinematics = source.own_kinematics;
  return header;
}

EstimateRow estimateOf(const tracking::Snapshot& snapshot) {
  return {.t = snapshot.t,
          .t_cam = snapshot.t_cam,
          .q_link_kin = snapshot.q_link_kin,
          .q_link_cam = snapshot.q_link_cam,
          .q_link_cam_sigma = snapshot.q_link_cam_sigma,
          .q_link_ukf = snapshot.q_link_ukf,
          .dq_link_ukf = snapshot.dq_link_ukf,
          .q_link_ukf_sigma = snapshot.q_link_ukf_sigma,
          .q_link_true = snapshot.q_link_true,
          .gate = static_cast<int>(snapshot.gate),
          .camera_updated = snapshot.camera_updated,
          .nis = snapshot.nis,
          .nees = snapshot.nees};
}

SessionSummary readSessionSummary(const std::filesystem::path& path) {
  Database database = openSession(path);
  try {
    SessionSummary summary;
    summary.header = readHeader(database);
    countRows(database, summary);
    findSpan(database, summary);
    Statement size(database, "SELECT width, height FROM codec ORDER BY id LIMIT 1");
    if (size.step()) {
      summary.width = static_cast<int>(size.integer(0));
      summary.height = static_cast<int>(size.integer(1));
    }
    summary.bytes = sizeOf(path) + sizeOf(path.string() + "-wal");
    return summary;
  } catch (const SqliteError& error) {
    throw damagedSession(path, error);
  }
}

std::vector<SessionEvent> readSessionEvents(const std::filesystem::path& path) {
  Database database = openSession(path);
  try {
    std::vector<SessionEvent> events;
    Statement rows = rowsOf(database, table(kEventTable));
    while (rows.step()) events.push_back({rows.real(1), rows.text(2), rows.text(3)});
    return events;
  } catch (const SqliteError& error) {
    throw damagedSession(path, error);
  }
}

std::vector<EstimateRow> readSessionEstimates(const std::filesystem::path& path) {
  Database database = openSession(path);
  try {
    std::vector<EstimateRow> estimates;
    Statement rows = rowsOf(database, table(kEstimateTable));
    while (rows.step()) {
      EstimateRow row;
      row.t = rows.real(1);
      row.t_cam = rows.real(2);
      int column = 3;
      for (Eigen::Vector3d* value : {&row.q_link_kin, &row.q_link_cam, &row.q_link_cam_sigma, &row.q_link_ukf,
                                     &row.dq_link_ukf, &row.q_link_ukf_sigma, &row.q_link_true}) {
        *value = vectorAt(rows, column);
        column += 3;
      }
      row.gate = static_cast<int>(rows.integer(24));
      row.camera_updated = rows.integer(25) != 0;
      row.nis = rows.real(26);
      row.nees = rows.real(27);
      estimates.push_back(row);
    }
    return estimates;
  } catch (const SqliteError& error) {
    throw damagedSession(path, error);
  }
}

}  // namespace capstan::recording
