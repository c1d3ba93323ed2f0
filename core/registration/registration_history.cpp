#include "core/registration/registration_history.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/vision/registration_file.h"

namespace capstan::registration {
namespace {

struct HistoryFile {
  std::vector<HistoryEntry> registrations;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.registrations, {"registrations", "", "registrations, oldest first"});
  }
};

void check(const HistoryEntry& entry, std::size_t index, const std::string& file) {
  const std::string key = fmt::format("registrations[{}]", index);
  if (entry.translation.has_value() != entry.rotation.has_value())
    throw base::InputError({file,
                            0,
                            key,
                            {},
                            "has only one of translation and rotation",
                            "Give both, or neither where there was no result"});
  if (entry.rotation && !vision::isRotation(*entry.rotation))
    throw base::InputError(
        {file, 0, key + ".rotation", {}, "is no rotation matrix", "Give one whose rows are orthonormal"});
}

void removeOldest(std::vector<HistoryEntry>& entries, std::size_t count) {
  entries.erase(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

void HistoryEntry::setPose(const Eigen::Isometry3d& base_from_camera) {
  translation = base_from_camera.translation();
  rotation = base_from_camera.linear();
}

std::optional<Eigen::Isometry3d> HistoryEntry::pose() const {
  if (!translation || !rotation) return std::nullopt;
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  base_from_camera.linear() = *rotation;
  base_from_camera.translation() = *translation;
  return base_from_camera;
}

HistoryEntry entryOf(Decision decision, const RegistrationProposal& proposal, const PointScatter& scatter) {
  HistoryEntry entry;
  entry.decision = decision;
  entry.method = Method::kHardStop;
  entry.rms = proposal.registration.rms;
  entry.used = scatter.used;
  entry.excluded = scatter.outliers;
  entry.setPose(proposal.registration.base_from_camera);
  return entry;
}

HistoryEntry entryOf(Decision decision, const PairRegistration& fit) {
  HistoryEntry entry;
  entry.decision = decision;
  entry.method = Method::kPoses;
  entry.rms = fit.rms;
  entry.leave_one_out_rms = fit.leave_one_out_rms;
  entry.used = static_cast<int>(std::ranges::count(fit.used, true));
  entry.excluded = static_cast<int>(fit.used.size()) - entry.used;
  entry.setPose(fit.base_from_camera);
  return entry;
}

std::vector<HistoryEntry> readHistory(const std::filesystem::path& path) {
  std::error_code fault;
  if (!std::filesystem::exists(path, fault)) return {};
  auto file = base::readYamlFile<HistoryFile>(path);
  for (std::size_t i = 0; i < file.registrations.size(); ++i) check(file.registrations[i], i, path.string());
  return std::move(file.registrations);
}

std::vector<HistoryEntry> addToHistory(const std::filesystem::path& path, const HistoryEntry& entry) {
  HistoryFile file{readHistory(path)};  // again: another program may have added entries
  file.registrations.push_back(entry);
  removeOldest(file.registrations,
               file.registrations.size() - std::min(kMostHistory, file.registrations.size()));
  std::string text = base::writeYaml(file);
  while (text.size() > base::kLongestYaml && file.registrations.size() > 1) {  // of long titles and reasons
    removeOldest(file.registrations, (file.registrations.size() + 3) / 4);
    text = base::writeYaml(file);
  }
  std::error_code fault;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), fault);
  base::writeTextFile(path, text);
  return std::move(file.registrations);
}

}  // namespace capstan::registration
