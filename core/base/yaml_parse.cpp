#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "core/base/yaml.h"

namespace capstan::base {
namespace {

int lineAt(const std::string& text, std::size_t position) {
  return 1 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

/// yaml-cpp takes the character 0x04 as the end of the file, and would ignore what follows.
void checkCharacters(const std::string& text, const std::string& file) {
  if (text.size() > kLongestYaml)
    throw InputError({file,
                      0,
                      {},
                      {},
                      fmt::format("has more than {} bytes", kLongestYaml),
                      "Check that it is the file that you mean"});
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError({file, 0, {}, {}, "is not in UTF-8", "Save it in UTF-8"});
  const auto control = std::find_if(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t';
  });
  if (control == text.end()) return;
  throw InputError({file,
                    lineAt(text, static_cast<std::size_t>(control - text.begin())),
                    {},
                    {},
                    fmt::format("has the control character 0x{:02x}", static_cast<unsigned>(*control)),
                    "Remove it: the file has to be text"});
}

[[noreturn]] void refuseSize(const std::string& file, const YAML::Mark& mark) {
  throw InputError(
      {file,
       mark.line + 1,
       {},
       {},
       fmt::format("has more than {} values, with those that aliases stand for", kMostYamlValues),
       "Write fewer values, and each once"});
}

[[noreturn]] void refuseDepth(const std::string& file, const YAML::Mark& mark) {
  throw InputError({file,
                    mark.line + 1,
                    {},
                    {},
                    fmt::format("is nested in more than {} levels", kDeepestYaml),
                    "Check the brackets, and aliases that contain themselves"});
}

/// Sees a text as yaml-cpp's events, before memory is taken for its values.
class EventCheck final : public YAML::EventHandler {
 public:
  explicit EventCheck(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0)
      throw InputError({file_,
                        mark.line + 1,
                        {},
                        {},
                        "begins a second document, or is text behind the end of the first",
                        "Write one document, and check the line before"});
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { add(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { add(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    add(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void add(const YAML::Mark& mark) {
    if (++values_ > 2 * kMostYamlValues) refuseSize(file_, mark);  // with keys
  }
  void enter(const YAML::Mark& mark) {
    add(mark);
    if (++depth_ > kDeepestYaml) refuseDepth(file_, mark);
  }

  const std::string& file_;
  std::size_t documents_ = 0, values_ = 0, depth_ = 0;
};

/// yaml-cpp reads the first document and ignores what is behind it.
void checkEvents(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  EventCheck check(file);
  if (parser.HandleNextDocument(check)) parser.HandleNextDocument(check);
}

/// Checks a parsed document: the number of its values, its depth and its keys.
class DocumentCheck {
 public:
  explicit DocumentCheck(const std::string& file) : file_(file) {}

  void check(const YAML::Node& node, std::size_t depth = 0) {
    if (++values_ > kMostYamlValues) refuseSize(file_, node.Mark());
    if (depth > kDeepestYaml) refuseDepth(file_, node.Mark());
    if (node.IsMap()) checkMap(node, depth);
    if (node.IsSequence())
      for (const auto& item : node) check(item, depth + 1);
  }

 private:
  void checkMap(const YAML::Node& node, std::size_t depth) {
    std::set<std::string> keys;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar())
        throw InputError({file_,
                          entry.first.Mark().line + 1,
                          {},
                          {},
                          "is no key",
                          "Give every value a key that is a text"});
      if (!keys.insert(entry.first.Scalar()).second)
        throw InputError(
            {file_, entry.first.Mark().line + 1, entry.first.Scalar(), {}, "is given twice", "Remove one"});
      check(entry.second, depth + 1);
    }
  }
  const std::string& file_;
  std::size_t values_ = 0;
};

}  // namespace

YAML::Node parseYamlText(const std::string& text, const std::string& file) {
  checkCharacters(text, file);
  try {
    checkEvents(text, file);
    const YAML::Node document = YAML::Load(text);
    DocumentCheck(file).check(document);
    return document;
  } catch (const YAML::Exception& error) {
    throw InputError(
        {file, error.mark.line + 1, {}, {}, "is not YAML: " + error.msg, "Correct the syntax in this line"});
  }
}

std::string readYamlTextFile(const std::filesystem::path& path) { return readTextFile(path, kLongestYaml); }

}  // namespace capstan::base
