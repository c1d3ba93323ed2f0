#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "core/tracking/snapshot.h"

namespace capstan::cli {

/// The joint plots of a report. Qt stays behind this header.
class ReportFigures {
 public:
  ReportFigures();
  ~ReportFigures();

  /// Keeps 200 rows a second and every camera sample; of a recording longer
  /// than some minutes the older part as lowest and highest values (JointHistory).
  void add(const tracking::Snapshot& snapshot);
  /// Writes joints.png, .pdf, .svg and .csv into `folder`; needs no display. False, and no file,
  /// without a single snapshot. Throws base::InputError when a file cannot be written.
  bool save(const std::array<std::string, 3>& joint_names, const std::filesystem::path& folder) const;
  double begin() const;  ///< of the time the plots show [s]
  double end() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::cli
