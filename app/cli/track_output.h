#pragma once

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/part_file.h"
#include "core/estimation/consistency.h"
#include "core/estimation/nis_verdict.h"
#include "core/live/streams/row_stream.h"
#include "core/recording/estimate_rows.h"
#include "core/tracking/health.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

namespace capstan::cli {

/// Test of the filter's consistency: the mean NIS of accepted camera samples by its degrees of freedom, and
/// its 95 % band.
struct NisVerdict {
  double mean = 0.0;
  estimation::Band band;  ///< 95 % band of the mean of a consistent filter
  bool passed() const { return band.contains(mean); }
  estimation::NisVerdict verdict() const { return estimation::judgeNis(mean, passed()); }
  /// "pass", "cautious" or "FAIL, too high".
  std::string text() const { return std::string(base::nameOf(verdict())); }
  /// Meaning of a verdict that is no pass, and the remedy; empty: it passed.
  std::string advice() const { return std::string(estimation::adviceOf(verdict())); }
};
/// Verdict of a report; empty if no camera sample was accepted.
std::optional<NisVerdict> nisVerdict(const tracking::TrackReport& report);

/// Text of a report for people: errors in deg, deg, mm; detection, gate, consistency. `seconds`: computing
/// time, for the speed; 0: not printed.
std::string textOf(const tracking::TrackReport& report, const tracking::SourceInfo& info, double seconds);
/// JSON of a report in SI: {"rms": {"kin": […], "cam": […], "ukf": […]}, "nis": …, "nis_band": […],
/// "samples": …, "reference": …, …}. It has no computing times, so that the same input gives the same
/// document.
nlohmann::json jsonOf(const tracking::TrackReport& report, const tracking::SourceInfo& info);
/// That JSON with the health of the estimator, the title of the recording and the robot of the filter:
/// `info.robot`, of the file `estimator_robot` where it is not empty.
nlohmann::json documentOf(const tracking::TrackReport& report, const tracking::SourceInfo& info,
                          const std::vector<tracking::HealthCheck>& health,
                          const std::string& estimator_robot);

/// Writer of estimates, one row per motor sample and per camera sample (recording::EstimateRows), to a file
/// or to other programs. Of a recording, a former file stays until the new one is complete. Of a live
/// session, the file has each row as soon as it exists, and a FIFO, standard output or a TCP port get the
/// rows by live::RowStream, which never slows the session.
class EstimateWriter {
 public:
  enum class Session { kRecorded, kLive };
  /// Opens `target`: a file whose suffix .jsonl selects JSON Lines, otherwise CSV; "-" for standard output;
  /// for a live session also tcp://ADDRESS:PORT to listen on. `format`: csv, jsonl, or auto (by the suffix).
  /// An empty target writes nothing. Throws base::InputError when it cannot be written.
  explicit EstimateWriter(const std::string& target, Session session = Session::kRecorded,
                          const std::string& format = "auto");
  void add(const tracking::Sample& sample, const tracking::Snapshot& snapshot);
  /// Writes the row that waits for its reference, since no sample follows at once.
  void waiting() {
    if (rows_) rows_->flush();
  }
  /// Completes the file. Throws base::InputError when not everything could be written.
  void close();
  /// Stream to other programs; null: none.
  const live::RowStream* stream() const { return stream_.get(); }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void openFile(Session session);

  std::string target_;
  bool flush_ = false;  ///< after each row
  std::optional<base::PartFile> part_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::unique_ptr<live::RowStream> stream_;
  std::optional<recording::EstimateRows> rows_;
};

}  // namespace capstan::cli
