#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/names.h"
#include "core/registration/pair_registration.h"
#include "core/registration/registration_guide.h"
#include "core/vision/registration_file.h"

/// History of the registrations that were accepted or rejected: a file (YAML) that the window and the command
/// line keep.
namespace capstan::registration {

enum class Decision {
  kAccepted,
  kRejected,
  kRestored,  ///< an earlier entry is in use again
  kImported   ///< a registration file is in use
};

enum class Method { kHardStop, kPoses, kFile };

/// One decision about a registration.
struct HistoryEntry {
  std::string date;  ///< local time, ISO 8601 to the second
  Decision decision = Decision::kAccepted;
  Method method = Method::kPoses;
  std::string robot;          ///< name of the robot, Description::name
  std::string session;        ///< title of the session, or the table of pairs
  std::string reason;         ///< of a rejection; of a restored entry its date, of an imported one its file
  std::optional<double> rms;  ///< RMS residual of the points used [m]
  std::optional<double> leave_one_out_rms;     ///< of several poses [m]
  int used = 0, excluded = 0;                  ///< number of points
  std::optional<Eigen::Vector3d> translation;  ///< of base_from_camera [m]; none: there was no result
  std::optional<Eigen::Matrix3d> rotation;     ///< of base_from_camera; none: there was no result

  /// Stores base_from_camera in translation and rotation.
  void setPose(const Eigen::Isometry3d& base_from_camera);
  /// base_from_camera; none: there was no result.
  std::optional<Eigen::Isometry3d> pose() const;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.date, {"date", "", "local time, ISO 8601"});
    field(self.decision, {"decision", "", "accepted, rejected, restored or imported"});
    field(self.method, {"method", "", "hard stop, several poses or file"});
    field(self.robot, {"robot", "", "name of the robot"});
    field(self.session, {"session", "", "title of the session or table of pairs", {}, false});
    field(self.reason, {"reason", "", "reason of a rejection, source of an earlier registration", {}, false});
    field(self.rms, {"rms", "m", "RMS residual of the points used", {0.0, 1e3}, false});
    field(self.leave_one_out_rms, {"leave_one_out_rms",
                                   "m",
                                   "RMS distance of each point from the fit of the others",
                                   {0.0, 1e3},
                                   false});
    field(self.used, {"used", "", "points used", {0.0, 1e9}, false});
    field(self.excluded, {"excluded", "", "points excluded", {0.0, 1e9}, false});
    field(self.translation, {"translation", "m", "translation of base_from_camera", {-100.0, 100.0}, false});
    field(self.rotation,
          {"rotation", "", "rotation of base_from_camera, by rows", vision::kRotationRange, false});
  }
};

/// Number of entries that a file keeps; the oldest are removed. 500 are less than half of base::kLongestYaml.
inline constexpr std::size_t kMostHistory = 500;

/// Entry of the proposal of a hard-stop registration, without date, robot and session.
HistoryEntry entryOf(Decision decision, const RegistrationProposal& proposal, const PointScatter& scatter);
/// The same of a fit of pairs of points.
HistoryEntry entryOf(Decision decision, const PairRegistration& fit);

/// Reads the entries of a history, oldest first; none where there is no file. Throws base::InputError with
/// file, key and remedy.
std::vector<HistoryEntry> readHistory(const std::filesystem::path& path);
/// Adds an entry to the file, which is replaced as a whole: a failure leaves the former one. Makes the folder
/// if there is none. Returns all entries. Throws base::InputError where the file cannot be read or written.
std::vector<HistoryEntry> addToHistory(const std::filesystem::path& path, const HistoryEntry& entry);

}  // namespace capstan::registration

template <>
struct capstan::base::NamesOf<capstan::registration::Decision> {
  using D = capstan::registration::Decision;
  static constexpr std::array value = {
      std::pair{D::kAccepted, "accepted"}, std::pair{D::kRejected, "rejected"},
      std::pair{D::kRestored, "restored"}, std::pair{D::kImported, "imported"}};
};
template <>
struct capstan::base::NamesOf<capstan::registration::Method> {
  using M = capstan::registration::Method;
  static constexpr std::array value = {std::pair{M::kHardStop, "hard stop"},
                                       std::pair{M::kPoses, "several poses"}, std::pair{M::kFile, "file"}};
};
