#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/names.h"

namespace capstan::experiments {

enum class Work {
  kIdentify,  ///< parameters of the robot from all trials together
  kTrack      ///< errors of every trial
};

/// Whose estimates are the robot of experiments that build on this one.
enum class Method { kDualUkf, kBatch };

/// Cameras blocked for a share of the time, at equal spacing (live::OcclusionSchedule).
struct OcclusionSpec {
  double percentage = 0.0;  ///< 0: never
  double interval = 2.0;    ///< [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.percentage, {"percentage", "%", "of the time", {0.0, 95.0}, false});
    field(self.interval, {"interval", "s", "length of each", {0.01, 1e4}, false});
  }
};

/// One run of a robot: simulated, or recorded before.
struct TrialSpec {
  std::string name;
  std::string recording;           ///< a session, measured table or motor log; empty: simulated
  std::string read_as;             ///< units of a measured table, as recording::parseReadAs() takes them
  std::string trajectory = "fls";  ///< of a simulation, as simulation::SimulationRequest::trajectory
  double duration = 200.0;         ///< of the movement [s]
  std::uint64_t seed = 1;
  OcclusionSpec occlusion;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "what tables and figures call it", {}, true});
    field(self.recording,
          {"recording", "", "session, measured table or motor log, in place of a simulation", {}, false});
    field(self.read_as, {"read_as", "", "units of a measured table: q_m=deg,q3=mm,t=ms", {}, false});
    field(self.trajectory,
          {"trajectory", "", "fls, sinusoid, hold, hard-stop, a trajectory file or a CSV", {}, false});
    field(self.duration, {"duration", "s", "length of the movement", {0.1, 86400.0}, false});
    field(self.seed, {"seed", "", "surgeon, noise and texture", {0.0, 9007199254740992.0}, false});
    field(self.occlusion, {"occlusion", "", "cameras blocked on schedule", {}, false});
  }
};

/// What an identifying experiment looks for.
struct IdentificationSpec {
  std::string parameters = "r_l,k_e,b_e,f_c";  ///< as identification::ParameterSet takes them
  std::string options;  ///< priors and goals (resources/identification/default.yaml); empty: the defaults
  Method robot = Method::kDualUkf;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.parameters, {"parameters", "", "of r_l1..3, k_e1..3, b_e1..3, f_c1..3", {}, false});
    field(self.options, {"options", "", "file of priors and goals", {}, false});
    field(self.robot, {"robot", "", "method whose robot goes on: dual-ukf or batch", {}, false});
  }
};

/// An experiment as data: resources/experiments/A.yaml … D.yaml, or anybody's file. Names of files are
/// relative to the specification's own folder.
struct Specification {
  std::string name;   ///< of its folder of results; letters, digits, - and _
  std::string title;  ///< one line
  Work work = Work::kTrack;
  std::string truth = "default";  ///< what a simulated robot really is: default, matched, or a truth file
  std::string nominal;            ///< robot file of simulations and tables; empty: the left RAVEN-II
  /// What the estimator assumes: one robot file, or names of identifying experiments whose parameters are
  /// put on the nominal robot, the last on top; empty: nominal.
  std::vector<std::string> robot;
  std::string tracking;  ///< file of filter options; empty: those of the recording, or the defaults
  bool images = true;    ///< of simulations; false: tip positions
  IdentificationSpec identification;
  std::vector<TrialSpec> trials;

  std::filesystem::path file;  ///< where it was read from; no field
  std::string text;            ///< as it was read; no field

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "short name of the experiment", {}, true});
    field(self.title, {"title", "", "what it is, in one line", {}, false});
    field(self.work, {"work", "", "identify or track", {}, true});
    field(self.truth, {"truth", "", "default, matched, or a truth file", {}, false});
    field(self.nominal, {"nominal", "", "nominal robot file", {}, false});
    field(self.robot, {"robot", "", "a robot file, or experiments that identified it", {}, false});
    field(self.tracking, {"tracking", "", "file of filter options", {}, false});
    field(self.images, {"images", "", "render pictures; false: tip positions", {}, false});
    field(self.identification, {"identification", "", "of work: identify", {}, false});
    field(self.trials, {"trials", "", "list of runs", {}, true});
  }

  /// A name as the specification means it: relative to its folder. Names that are no files of it stay.
  std::string resolved(const std::string& written) const;
  /// The experiments that `robot` names; empty where it is a robot file or nominal.
  std::vector<std::string> needs() const;
  /// `robot` is a robot file.
  bool robotIsFile() const;
  /// Line of `key` in the text, of the trial called `trial` where that is not empty, or of the trial's begin
  /// where it leaves the key out; 0: not known.
  int lineOf(const std::string& trial, const std::string& key) const;
};

/// Throws base::InputError naming file, line, key, value and remedy.
Specification readSpecification(const std::filesystem::path& file);
Specification parseSpecification(const std::string& text, const std::filesystem::path& file);

/// The specification of experiment `name`: NAME.yaml beside `beside` (a file; empty: none), else that of the
/// resources (A, B, C, D). Throws base::InputError where there is none.
Specification findSpecification(const std::string& name, const std::filesystem::path& beside = {});

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::Work> {
  using E = capstan::experiments::Work;
  static constexpr std::array value = {std::pair{E::kIdentify, "identify"}, std::pair{E::kTrack, "track"}};
};

template <>
struct capstan::base::NamesOf<capstan::experiments::Method> {
  using E = capstan::experiments::Method;
  static constexpr std::array value = {std::pair{E::kDualUkf, "dual-ukf"}, std::pair{E::kBatch, "batch"}};
};
