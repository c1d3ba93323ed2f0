#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/names.h"

namespace capstan::experiments {

/// Kind of an experiment.
enum class Work {
  kIdentify,  ///< identifies parameters of the robot from all trials together
  kTrack      ///< measures tracking errors of every trial
};

/// Method of identification whose robot is used.
enum class Method { kDualUkf, kBatch };

/// Occlusions: both cameras are blocked for a share of the time, in equally spaced intervals
/// (live::OcclusionSchedule).
struct OcclusionSpec {
  double percentage = 0.0;  ///< share of the time [%]; 0: never
  double interval = 2.0;    ///< duration of each occlusion [s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.percentage, {"percentage", "%", "share of the time", {0.0, 95.0}, false});
    field(self.interval, {"interval", "s", "duration of each occlusion", {0.01, 1e4}, false});
  }
};

/// One trial: a simulated or a recorded motion.
struct TrialSpec {
  std::string name;
  std::string recording;           ///< a session, measured table or motor log; empty: simulated
  std::string read_as;             ///< units of a measured table, in the syntax of recording::parseReadAs()
  std::string trajectory = "fls";  ///< as simulation::SimulationRequest::trajectory
  double duration = 200.0;         ///< duration of a simulated movement [s]
  std::uint64_t seed = 1;
  OcclusionSpec occlusion;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "name in tables and figures", {}, true});
    field(self.recording,
          {"recording", "", "session, measured table or motor log, in place of a simulation", {}, false});
    field(self.read_as, {"read_as", "", "units of a measured table: q_m=deg,q3=mm,t=ms", {}, false});
    field(self.trajectory,
          {"trajectory", "", "fls, sinusoid, hold, hard-stop, a trajectory file or a CSV", {}, false});
    field(self.duration, {"duration", "s", "length of the movement", {0.1, 86400.0}, false});
    field(self.seed, {"seed", "", "seed of surgeon, noise and texture", {0.0, 9007199254740992.0}, false});
    field(self.occlusion, {"occlusion", "", "cameras blocked on schedule", {}, false});
  }
};

/// Options of an identifying experiment.
struct IdentificationSpec {
  std::string parameters = "r_l,k_e,b_e,f_c";  ///< names for identification::ParameterSet
  std::string options;  ///< priors and goals (resources/identification/default.yaml); empty: the defaults
  Method robot = Method::kDualUkf;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.parameters, {"parameters", "", "names: r_l1..3, k_e1..3, b_e1..3, f_c1..3", {}, false});
    field(self.options, {"options", "", "file of priors and goals", {}, false});
    field(self.robot, {"robot", "", "method whose robot is used: dual-ukf or batch", {}, false});
  }
};

/// Specification of an experiment: resources/experiments/A.yaml … D.yaml, or a user's file. File names are
/// relative to the folder of the specification.
struct Specification {
  std::string name;   ///< name of the experiment and its folder of results: letters, digits, - and _
  std::string title;  ///< title in one line
  Work work = Work::kTrack;
  std::string truth = "default";  ///< truth of simulated robots: default, matched, or a truth file
  std::string nominal;            ///< robot file of simulations and tables; empty: the left RAVEN-II
  /// Robot that the estimator assumes: one robot file, or names of identifying experiments. Their parameters
  /// are applied to the nominal robot in this order. Empty: nominal.
  std::vector<std::string> robot;
  std::string tracking;  ///< file of filter options; empty: those of the recording, or the defaults
  bool images = true;    ///< true: simulations render images; false: tip positions
  IdentificationSpec identification;
  std::vector<TrialSpec> trials;

  std::filesystem::path file;  ///< file it was read from; not a field of the file
  std::string text;            ///< text of that file; not a field of the file

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "short name of the experiment", {}, true});
    field(self.title, {"title", "", "title in one line", {}, false});
    field(self.work, {"work", "", "identify or track", {}, true});
    field(self.truth, {"truth", "", "default, matched, or a truth file", {}, false});
    field(self.nominal, {"nominal", "", "nominal robot file", {}, false});
    field(self.robot, {"robot", "", "a robot file, or experiments that identified it", {}, false});
    field(self.tracking, {"tracking", "", "file of filter options", {}, false});
    field(self.images, {"images", "", "render images; false: tip positions", {}, false});
    field(self.identification, {"identification", "", "options of work: identify", {}, false});
    field(self.trials, {"trials", "", "list of trials", {}, true});
  }

  /// Path of a file name in the specification, relative to its folder. Other names are returned unchanged.
  std::string resolved(const std::string& written) const;
  /// Names of the experiments in `robot`; empty where it is a robot file or nominal.
  std::vector<std::string> needs() const;
  /// True when `robot` is a robot file.
  bool robotIsFile() const;
  /// Line number of `key` in the text; with `trial`, that in the trial of this name, or the first line of the
  /// trial where it has no such key. 0: not known.
  int lineOf(const std::string& trial, const std::string& key) const;
};

/// Reads a specification from a file or from its text. Throws base::InputError with file, line, key, value
/// and remedy.
Specification readSpecification(const std::filesystem::path& file);
Specification parseSpecification(const std::string& text, const std::filesystem::path& file);

/// Specification of experiment `name`: NAME.yaml in the folder of the file `beside` (empty: none), else that
/// of the resources (A, B, C, D). Throws base::InputError where there is none.
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
