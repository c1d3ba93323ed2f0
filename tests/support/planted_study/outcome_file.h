#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/planted_study/case_outcome.h"

namespace capstan::study {

/// File of case outcomes, one line of JSON per case, so that an interrupted study can continue:
///     {"name": …, "made_by": …, "checksum": …, "outcome": {…}}
/// A case in the file is not run again, unless it is from another program or from other options.
class OutcomeFile {
 public:
  /// Reads an existing file; keep() creates `file` and its folder. An incomplete last line, as after an
  /// interruption, is removed with a notice. Throws base::InputError with file and line if another line is
  /// damaged, and if the file cannot be read.
  OutcomeFile(std::filesystem::path file, std::string made_by);

  /// Outcome of a case by this program and these options, or, with `any_maker`, the last stored one of any.
  /// It is a copy.
  std::optional<CaseOutcome> find(const StudyCase& one, bool any_maker = false) const;
  /// Appends an outcome at once, as one whole line; thread-safe. Throws base::InputError if the file cannot
  /// be written.
  void keep(const CaseOutcome& outcome);

  /// Remarks on a removed line and on lines of other programs.
  const std::vector<std::string>& notices() const { return notices_; }

 private:
  struct Kept {
    std::string made_by;
    CaseOutcome outcome;
  };
  std::size_t read(const std::string& text);

  std::filesystem::path file_;
  std::string made_by_;
  std::map<std::string, std::vector<Kept>> kept_;  ///< by name, in the order of the file
  std::vector<std::string> notices_;
  mutable std::mutex mutex_;
};

}  // namespace capstan::study
