#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/results.h"
#include "core/experiments/results_json.h"
#include "core/experiments/series.h"

namespace capstan::experiments {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kFormat = 3;  ///< 2: trajectories of identifications; 3: the augmented filter
constexpr const char* kFormatKey = "capstan_experiment_results";
constexpr const char* kStampKey = "stamp";  ///< key of the stamp in both files: checksum of both without it

std::string traceCsv(const IdentificationResult& identification) {
  std::string text = "t";
  for (const auto& parameter : identification.parameters)
    text += fmt::format(",{0},{0}_sigma", parameter.name);
  text += '\n';
  for (const auto& point : identification.trace) {
    text += fmt::format("{}", point.t);
    for (std::size_t i = 0; i < point.value.size(); ++i)
      text += fmt::format(",{},{}", point.value[i], point.sigma[i]);
    text += '\n';
  }
  return text;
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string parametersCsv(const IdentificationResult& identification) {
  std::string text = "parameter,nominal,truth,settled_at";
  for (const char* method : {"dual_ukf", "batch"})
    text += fmt::format(",{0},{0}_sigma,{0}_low95,{0}_high95,{0}_seen", method);
  text += '\n';
  for (const auto& p : identification.parameters) {
    text += fmt::format("{},{},{},{}", p.name, number(p.nominal), number(p.truth),
                        number(p.settled_at.value_or(kNone)));
    for (const ParameterEstimate* e : {&p.dual_ukf, &p.batch})
      text += fmt::format(",{},{},{},{},{}", number(e->value), number(e->sigma), number(e->low),
                          number(e->high), e->seen ? 1 : 0);
    text += '\n';
  }
  return text;
}

void writeCsv(const TrialMotion& motion, const fs::path& folder) {
  const std::string stem = fileNameOf(motion.name);
  base::writeTextFile(folder / (stem + "-trajectory.csv"), csvOfSeries(motion.trajectory));
  base::writeTextFile(folder / (stem + "-camera.csv"), csvOfSeries(motion.camera));
}

void writeCsv(const Results& results, const fs::path& folder) {
  for (const TrialResult& trial : results.trials) {
    writeCsv(trial, folder);
    base::writeTextFile(folder / (fileNameOf(trial.name) + "-errors.csv"), csvOfSeries(trial.errors));
  }
  if (!results.identification) return;
  for (const TrialMotion& motion : results.identification->motions) writeCsv(motion, folder);
  base::writeTextFile(folder / "trace.csv", traceCsv(*results.identification));
  base::writeTextFile(folder / "parameters.csv", parametersCsv(*results.identification));
  base::writeTextFile(folder / "robot.yaml", results.identification->robot);
}

json timingOf(const Results& results) {
  json timing = {{"wall_seconds", results.wall_seconds}, {"trials", json::object()}};
  for (const TrialResult& trial : results.trials) timing["trials"][trial.name] = trial.seconds;
  if (results.identification)
    timing["identification"] = {{"collect", results.identification->collect_seconds},
                                {"dual_ukf", results.identification->dual_seconds},
                                {"batch", results.identification->batch_seconds}};
  return timing;
}

void takeTiming(const json& timing, Results& results) {
  const json& wall = timing.at("wall_seconds");
  results.wall_seconds = wall.is_null() ? kNone : wall.get<double>();
  for (TrialResult& trial : results.trials) trial.seconds = timing.at("trials").at(trial.name).get<double>();
  if (!results.identification) return;
  const json& seconds = timing.at("identification");
  results.identification->collect_seconds = seconds.at("collect").get<double>();
  results.identification->dual_seconds = seconds.at("dual_ukf").get<double>();
  results.identification->batch_seconds = seconds.at("batch").get<double>();
}

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw base::InputError({file.string(), 0, {}, {}, reason, "Run the experiment again into that folder"});
}

/// Calls `take` with the JSON document of `file`; its errors name the file.
template <class Take>
void readJson(const fs::path& file, Take&& take) {
  try {
    take(json::parse(base::readTextFile(file)));
  } catch (const json::exception& error) {
    refuse(file, std::string("is damaged (") + error.what() + ")");
  }
}

}  // namespace

void writeResults(const Results& results, const fs::path& folder) {
  fs::create_directories(folder);
  json document = headOf(results), series = json::object();
  document[kFormatKey] = kFormat;
  document["trials"] = json::array();
  series["trials"] = json::array();
  for (const TrialResult& trial : results.trials) {
    document["trials"].push_back(numbersOf(trial));
    series["trials"].push_back(seriesOf(trial));
  }
  if (results.identification) {
    document["identification"] = numbersOf(*results.identification);
    series["identification"] = seriesOf(*results.identification);
  }
  const std::string stamp = base::checksumOf(document.dump() + series.dump());
  document[kStampKey] = stamp;
  series[kStampKey] = stamp;
  writeCsv(results, folder);
  base::writeTextFile(folder / "series.json", series.dump() + "\n");
  base::writeTextFile(folder / "timing.json", timingOf(results).dump(1) + "\n");
  base::writeTextFile(folder / "results.json", document.dump(1) + "\n");
}

Results readResults(const fs::path& folder) {
  Results results;
  std::string stamp;
  const fs::path file = folder / "results.json";
  if (!fs::exists(file)) refuse(file, "does not exist");
  readJson(file, [&](const json& document) {
    if (!document.contains(kFormatKey)) refuse(file, "holds no results of an experiment");
    if (document.at(kFormatKey) != kFormat) refuse(file, "is of another version of this program");
    stamp = document.value(kStampKey, std::string());
    takeHead(document, results);
    for (const json& trial : document.at("trials")) takeNumbers(trial, results.trials.emplace_back());
    if (document.contains("identification"))
      takeNumbers(document.at("identification"), results.identification.emplace());
  });
  readJson(folder / "series.json", [&](const json& series) {
    if (series.value(kStampKey, std::string()) != stamp)
      refuse(folder / "series.json", "is of another run than results.json beside it");
    for (std::size_t i = 0; i < results.trials.size(); ++i)
      takeSeries(series.at("trials").at(i), results.trials[i]);
    if (results.identification) takeSeries(series.at("identification"), *results.identification);
  });
  if (fs::exists(folder / "timing.json"))
    readJson(folder / "timing.json", [&](const json& timing) { takeTiming(timing, results); });
  return results;
}

}  // namespace capstan::experiments
