#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/learn_output.h"
#include "app/cli/pose_motions.h"
#include "app/python/native/correction.h"
#include "app/python/native/json.h"
#include "app/python/native/module.h"
#include "app/python/native/table_input.h"
#include "app/python/native/work.h"
#include "core/base/same_recording.h"
#include "core/base/software.h"
#include "core/learning/model/correction_source.h"
#include "core/learning/poses/check_tables.h"
#include "core/math/dense.h"
#include "core/recording/pose_table.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// Tables and options of learn(), with the names and meanings of `capstan-cli learn`.
struct LearnInput {
  std::vector<TableInput> train, test;
  learning::LearningOptions options;
  double hold_out = 0.0;  ///< percent of the trajectories
  Correction onto;
};

std::vector<learning::RawMotion> motionsOf(const std::vector<TableInput>& tables, base::Progress* progress) {
  if (tables.empty()) return {};
  if (areFiles(tables)) return recording::readPoseTables(namesOf(tables), progress);
  refuseRepeatedArrays(tables);
  std::vector<learning::RawMotion> all;
  for (const TableInput& table : tables)
    for (learning::RawMotion& motion : recording::readPoseTable(table.columns(), table.name())) {
      if (tables.size() > 1) motion.name = table.name() + ", " + motion.name;
      all.push_back(std::move(motion));
    }
  return all;
}

void refuseTestOfTraining(const LearnInput& input) {
  for (const TableInput& test : input.test)
    for (const TableInput& train : input.train) {
      const bool same = test.isFile() && train.isFile() ? base::sameRecording(train.name(), test.name())
                                                        : train.sameArrays(test);
      if (same)
        cli::refuseFile(test.name(), "is also a training table: errors on it are no test",
                        "Test on other trajectories");
    }
}

/// The model's source: files by their bytes, arrays by their numbers.
learning::CorrectionSource sourceOf(const LearnInput& input, const learning::LearningReport& report) {
  const learning::CorrectionSource before = input.onto ? input.onto->source : learning::CorrectionSource{};
  const bool files = areFiles(input.train);
  auto source = learning::correctionSource(files ? namesOf(input.train) : std::vector<std::string>{},
                                           input.options.towards, report, base::software(), before);
  if (files) return source;
  for (const TableInput& table : input.train) {
    source.files.push_back(table.name());
    source.checksums.push_back(table.checksum());
  }
  return source;
}

void checkOnto(const LearnInput& input) {
  cli::checkProcesses(input.onto->model, "onto");
  for (const auto* tables : {&input.train, &input.test})
    for (const TableInput& table : *tables) {
      if (table.isFile()) {
        cli::checkNew({table.name()}, input.onto->source);
      } else if (std::ranges::count(input.onto->source.checksums, table.checksum()) > 0) {
        cli::refuseFile(table.name(), "is already part of the training",
                        "Give motions that are new to the model");
      }
    }
}

/// Restores the number of BLAS threads, which NumPy shares.
class KeptDenseThreads {
 public:
  ~KeptDenseThreads() { math::setDenseThreads(before_); }

 private:
  int before_ = math::denseThreads();
};

struct Learned {
  cli::LearnOutput output;
  Correction model;  ///< null: cancelled
};

Learned learn(const LearnInput& input, base::Progress& progress) {
  const std::vector<learning::RawMotion> tests = motionsOf(input.test, nullptr);
  if (!tests.empty()) learning::checkTables(tests, input.options.towards);
  const std::vector<std::string> names = namesOf(input.train);
  if (input.onto) checkOnto(input);
  Learned learned{{recording::namingTables(names,
                                           [&] {
                                             const auto motions = motionsOf(input.train, &progress);
                                             if (!input.onto)
                                               return learning::learn(motions, input.options, &progress);
                                             return learning::learnMore(input.onto->model,
                                                                        input.onto->source.clock_offset,
                                                                        motions, input.options, &progress);
                                           }),
                   {},
                   {}},
                  nullptr};
  const learning::LearningReport& report = learned.output.report;
  if (report.cancelled) return learned;
  learned.model = std::make_shared<learning::CorrectionFile>(
      learning::CorrectionFile{report.model, sourceOf(input, report)});
  if (!tests.empty()) learned.output.test = cli::testedOn(tests, report, input.options);
  if (input.hold_out == 0.0) return learned;
  const learning::HoldOut hold_out{input.hold_out / 100.0, input.options.correction.seed};
  learned.output.held_out = recording::namingTables(
      names, [&] { return learning::evaluateHeldOut(report.prepared, input.options, hold_out, &progress); });
  return learned;
}

}  // namespace

void addLearn(py::module_& module) {
  module.def(
      "learn",
      [](const py::list& train, const py::list& test, double hold_out, const std::string& method,
         const std::string& towards, const std::string& kernel, bool cleaning, bool weights, bool alignment,
         int members, int inducing, int threads, std::uint64_t seed, const Correction& onto,
         const py::object& progress) {
        LearnInput input{tableInputs(train), tableInputs(test), {}, hold_out, onto};
        refuseTestOfTraining(input);
        learning::LearningOptions& options = input.options;
        options.towards =
            towards == "command" ? learning::StreamKind::kCommand : learning::StreamKind::kRobot;
        if (onto) options.towards = onto->source.towards;
        options.clean = cleaning;
        options.weigh = weights;
        options.align = alignment;
        options.rigid = method == "offset";
        options.correction.motion = base::fromName<learning::Motion>(method);
        options.correction.fit.kernel = *base::fromName<learning::Kernel>(kernel);
        options.correction.members = members;
        options.correction.inducing_points = inducing;
        options.correction.threads = threads;
        options.correction.seed = seed;
        const KeptDenseThreads kept;
        Learned learned = cancellable(progress, [&](base::Progress& p) { return learn(input, p); });
        py::dict result;
        result["report"] = documentToPython(jsonOf(learned.output));
        result["model"] = learned.model;
        return result;
      },
      py::arg("train"), py::kw_only(), py::arg("test"), py::arg("hold_out"), py::arg("method"),
      py::arg("towards"), py::arg("kernel"), py::arg("cleaning"), py::arg("weights"), py::arg("alignment"),
      py::arg("members"), py::arg("inducing"), py::arg("threads"), py::arg("seed"), py::arg("onto"),
      py::arg("progress"));
}

}  // namespace capstan::python
