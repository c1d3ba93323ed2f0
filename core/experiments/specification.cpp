#include "core/experiments/specification.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "core/experiments/results.h"

namespace capstan::experiments {
namespace {

bool isYaml(const std::string& name) {
  const auto suffix = std::filesystem::path(name).extension();
  return suffix == ".yaml" || suffix == ".yml";
}

bool isPlainName(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

/// Checks conditions on several fields together; an error has the line of the field.
class Checker {
 public:
  Checker(const Specification& specification, YAML::Node root, std::string file)
      : specification_(specification), root_(std::move(root)), file_(std::move(file)) {}

  void check() const {
    if (!isPlainName(specification_.name))
      refuse(root_["name"], "name", "is no name of a folder", "Use letters, digits, - and _");
    checkRobot();
    if (specification_.trials.empty())
      refuse(root_["trials"], "trials", "has no trial", "Add at least one, with a name");
    std::set<std::string> names;
    for (std::size_t i = 0; i < specification_.trials.size(); ++i) {
      checkTrial(i);
      if (!names.insert(fileNameOf(specification_.trials[i].name)).second)
        refuse(root_["trials"][i]["name"], trialKey(i, "name"),
               "is the name of two trials, or would be that of two files",
               "Give each its own: only letters, digits and _ distinguish them");
    }
    if (specification_.work == Work::kTrack && root_["identification"].IsDefined())
      refuse(root_["identification"], "identification", "is of no use where work is track",
             "Set work: identify, or remove it");
  }

 private:
  void checkRobot() const {
    const auto& robot = specification_.robot;
    for (std::size_t i = 0; i < robot.size(); ++i) {
      const std::string key = "robot[" + std::to_string(i) + "]";
      if (isYaml(robot[i]) && robot.size() > 1)
        refuse(root_["robot"][i], key, "is a robot file beside others",
               "Give one robot file, or experiments");
      if (!isYaml(robot[i]) && !isPlainName(robot[i]))
        refuse(root_["robot"][i], key, "is neither a robot file (.yaml) nor the name of an experiment",
               "Give a path that ends in .yaml, or names as A, B");
      if (robot[i] == specification_.name)
        refuse(root_["robot"][i], key, "is this experiment itself", "Name the one that identifies the robot");
    }
  }

  void checkTrial(std::size_t i) const {
    const TrialSpec& trial = specification_.trials[i];
    const YAML::Node node = root_["trials"][i];
    if (trial.name.empty()) refuse(node["name"], trialKey(i, "name"), "is empty", "Name the trial");
    if (trial.recording.empty()) return;
    for (const char* key : {"trajectory", "duration", "seed"})
      if (node[key].IsDefined())
        refuse(node[key], trialKey(i, key), "is of a simulation, but the trial is a recording",
               "Remove it, or the recording");
  }

  static std::string trialKey(std::size_t i, const std::string& key) {
    return "trials[" + std::to_string(i) + "]." + key;
  }
  void refuse(const YAML::Node& node, const std::string& key, const std::string& reason,
              const std::string& remedy = {}) const {
    base::refuseYaml(node.IsDefined() ? node : root_, {file_, key}, reason, remedy);
  }

  const Specification& specification_;
  YAML::Node root_;
  std::string file_;
};

}  // namespace

std::string Specification::resolved(const std::string& written) const {
  const std::filesystem::path path(written);
  if (written.empty() || path.is_absolute()) return written;
  std::error_code ignored;
  const auto beside = file.parent_path() / path;
  return std::filesystem::exists(beside, ignored) ? beside.string() : written;
}

int Specification::lineOf(const std::string& trial, const std::string& key) const {
  if (text.empty()) return 0;
  const YAML::Node root = base::parseYamlText(text, file.string());
  YAML::Node block = root;
  for (std::size_t i = 0; !trial.empty() && i < trials.size(); ++i)
    if (trials[i].name == trial) block.reset(root["trials"][i]);
  const YAML::Node node = block[key];
  return (node.IsDefined() ? node : block).Mark().line + 1;
}

bool Specification::robotIsFile() const { return robot.size() == 1 && isYaml(robot.front()); }

std::vector<std::string> Specification::needs() const {
  return robotIsFile() ? std::vector<std::string>{} : robot;
}

Specification parseSpecification(const std::string& text, const std::filesystem::path& file) {
  auto specification = base::readYaml<Specification>(text, file.string());
  specification.file = file;
  specification.text = text;
  Checker(specification, base::parseYamlText(text, file.string()), file.string()).check();
  return specification;
}

Specification readSpecification(const std::filesystem::path& file) {
  return parseSpecification(base::readYamlTextFile(file), file);
}

Specification findSpecification(const std::string& name, const std::filesystem::path& beside) {
  std::error_code ignored;
  const auto sibling = beside.parent_path() / (name + ".yaml");
  if (!beside.empty() && std::filesystem::exists(sibling, ignored)) return readSpecification(sibling);
  try {
    return readSpecification(base::resource("experiments/" + name + ".yaml"));
  } catch (const base::InputError& error) {
    if (error.fault().file != "experiments/" + name + ".yaml") throw;
    throw base::InputError({beside.string(), 0, "experiment", name, "is not known",
                            beside.empty()
                                ? "Give A, B, C, D, all, or a specification (" + name + ".yaml)"
                                : "Give A, B, C, D, or put " + name + ".yaml beside the specification"});
  }
}

}  // namespace capstan::experiments
