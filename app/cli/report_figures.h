#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "core/tracking/snapshot.h"

namespace capstan::cli {

/// Joint plots of a report. This header needs no Qt.
class ReportFigures {
 public:
  ReportFigures();
  ~ReportFigures();

  /// Keeps 200 rows per second and every camera sample. Of a recording longer than some minutes, the older
  /// part is kept as lowest and highest values (JointHistory).
  void add(const tracking::Snapshot& snapshot);
  /// Writes joints.png, .pdf, .svg and .csv into `folder`; needs no display. Without any snapshot it writes
  /// no file and returns false. Throws base::InputError when a file cannot be written.
  bool save(const std::array<std::string, 3>& joint_names, const std::filesystem::path& folder) const;
  double begin() const;  ///< begin of the time that the plots show [s]
  double end() const;    ///< end of the time that the plots show [s]

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::cli
