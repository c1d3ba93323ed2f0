#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/planted_study/case_outcome.h"

namespace capstan::study {

/// Outcomes of cases, a line of JSON each, so that an interrupted study goes on where it stopped:
///     {"name": …, "made_by": …, "checksum": …, "outcome": {…}}
/// A case that is in the file is not run again, unless another program (or other options) made it.
class OutcomeFile {
 public:
  /// Reads what is there; `file` and its folder are created by the first keep(). A last line that is not
  /// whole, as an interruption leaves it, is cut off with a word in notices(). base::InputError with file and
  /// line where any other line is damaged, and where the file cannot be read.
  OutcomeFile(std::filesystem::path file, std::string made_by);

  /// Of this program and these options; of any with `any_maker`, the last one kept. The answer is a copy.
  std::optional<CaseOutcome> find(const StudyCase& one, bool any_maker = false) const;
  /// Appends, at once and whole. Any thread. base::InputError where the file cannot be written.
  void keep(const CaseOutcome& outcome);

  /// Cut off line, lines of other makers.
  const std::vector<std::string>& notices() const { return notices_; }

 private:
  struct Kept {
    std::string made_by;
    CaseOutcome outcome;
  };
  std::size_t read(const std::string& text);

  std::filesystem::path file_;
  std::string made_by_;
  std::map<std::string, std::vector<Kept>> kept_;  ///< by name, as they were kept
  std::vector<std::string> notices_;
  mutable std::mutex mutex_;
};

}  // namespace capstan::study
