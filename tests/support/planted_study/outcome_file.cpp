#include "tests/support/planted_study/outcome_file.h"

#include <fmt/format.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::study {
namespace {

using nlohmann::json;

/// FNV-1a, 64 bit.
std::string checksum(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{:016x}", hash);
}

struct Line {
  std::string made_by;
  CaseOutcome outcome;
};

/// Throws whatever is wrong with it.
Line parsed(std::string_view text) {
  const json line = json::parse(text);
  const json& outcome = line.at("outcome");
  if (line.at("checksum") != checksum(outcome.dump())) throw std::invalid_argument("wrong checksum");
  return {line.at("made_by").get<std::string>(), outcomeFrom(outcome)};
}

}  // namespace

OutcomeFile::OutcomeFile(std::filesystem::path file, std::string made_by)
    : file_(std::move(file)), made_by_(std::move(made_by)) {
  if (!std::filesystem::exists(file_)) return;
  const std::string text = base::readTextFile(file_);
  const std::size_t whole = read(text);
  if (whole < text.size()) std::filesystem::resize_file(file_, whole);
  std::size_t others = 0;
  for (const auto& [name, list] : kept_)
    for (const Kept& kept : list) others += kept.made_by != made_by_;
  if (others > 0)
    notices_.push_back(fmt::format("{}: {} cases of another program or other options are left aside",
                                   file_.string(), others));
}

/// Bytes that are whole lines.
std::size_t OutcomeFile::read(const std::string& text) {
  int number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    try {
      if (end == std::string::npos) throw std::invalid_argument("it has no end");
      Line line = parsed(std::string_view(text).substr(begin, end - begin));
      kept_[line.outcome.of.name()].push_back({std::move(line.made_by), std::move(line.outcome)});
    } catch (const std::exception& error) {
      if (end != std::string::npos && end + 1 < text.size())
        throw base::InputError({file_.string(), number, "", "", fmt::format("is damaged ({})", error.what()),
                                "Remove this line; its case is run again."});
      notices_.push_back(
          fmt::format("{}:{}: the last line is not whole and was cut off; its case is run again",
                      file_.string(), number));
      return begin;
    }
    begin = end + 1;
  }
  return text.size();
}

std::optional<CaseOutcome> OutcomeFile::find(const StudyCase& one, bool any_maker) const {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find(one.name());
  if (found == kept_.end()) return std::nullopt;
  for (auto kept = found->second.rbegin(); kept != found->second.rend(); ++kept)
    if (any_maker || kept->made_by == made_by_) return kept->outcome;
  return std::nullopt;
}

void OutcomeFile::keep(const CaseOutcome& outcome) {
  const json content = jsonOf(outcome);
  const json line = {{"name", outcome.of.name()},
                     {"made_by", made_by_},
                     {"checksum", checksum(content.dump())},
                     {"outcome", content}};
  const std::lock_guard lock(mutex_);
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path());
  std::ofstream out(file_, std::ios::binary | std::ios::app);
  out << line.dump() + "\n";
  if (!out.flush())
    throw base::InputError({file_.string(), 0, "", "", "cannot be written",
                            "Free space on the disk, or name another folder with --out."});
  kept_[outcome.of.name()].push_back({made_by_, outcome});
}

}  // namespace capstan::study
