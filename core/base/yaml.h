#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/error.h"
#include "core/base/field.h"
#include "core/base/names.h"

/// Typed YAML: reads and writes whole structs that declare their fields (field.h). Every mistake in a file
/// throws an InputError that names file, line, key, value and allowed range.
namespace capstan::base {

/// Location of a YAML node, for error messages about it.
struct YamlPlace {
  std::string file;
  std::string key;  ///< full path of the key, as in `joints[1].cable.stiffness`
};

/// Throws an InputError about `node` at `place`, with its line and value.
[[noreturn]] void refuseYaml(const YAML::Node& node, const YamlPlace& place, const std::string& reason,
                             const std::string& remedy = {});
/// Throws an InputError about a list that has not `wanted` values.
[[noreturn]] void refuseLength(const YAML::Node& node, const YamlPlace& place, std::size_t wanted);
inline constexpr const char* kBlockRemedy =
    "Write its keys on the lines below it, each as key: value, indented";
inline constexpr const char* kListRemedy = "Write it as [a, b, c]";
/// Limits of a YAML text: files of strangers may be made to exhaust memory or stack. The largest file of
/// resources/ has 10 KB.
inline constexpr std::size_t kLongestYaml = 1U << 20;    ///< [bytes]
inline constexpr std::size_t kMostYamlValues = 200'000;  ///< an alias counts as all that it stands for
inline constexpr std::size_t kDeepestYaml = 32;          ///< levels of blocks and lists
/// Parses `text`, which is one document in UTF-8. Throws InputError under the name `file` for syntax errors,
/// other control characters than line ends and tabs, a key that is given twice or is no text, and a text
/// beyond the limits.
YAML::Node parseYamlText(const std::string& text, const std::string& file);
inline constexpr std::uint64_t kLongestText = std::uint64_t{1}
                                              << 32U;  ///< of a text file that is read whole [bytes]
/// Text of the whole file. Throws InputError when it cannot be opened, and when it has more than `most`
/// bytes.
std::string readTextFile(const std::filesystem::path& path, std::uint64_t most = kLongestText);
/// The same of a YAML file, with kLongestYaml.
std::string readYamlTextFile(const std::filesystem::path& path);
/// Writes `text` to `path` through a temporary file beside it, so that a failure leaves the old content.
void writeTextFile(const std::filesystem::path& path, const std::string& text);
/// Parses a number as YAML does. Throws InputError for text, NaN, infinity and numbers outside info.range.
double yamlNumber(const YAML::Node& node, const YamlPlace& place, const FieldInfo& info);
/// Throws InputError for keys of the map `node` that are not in `known`; remedy as remedyForUnknown().
void refuseUnknownKeys(const YAML::Node& node, const YamlPlace& place, const std::vector<std::string>& known);
/// Remedy for the unknown `key`: proposes the known key at most two letters away, else lists all known keys.
std::string remedyForUnknown(const std::string& key, const std::vector<std::string>& known);
/// Shortest decimal text that reads back as the same double.
std::string yamlText(double value);

template <class T>
concept Visitable = requires(T& value) {
  T::visit(value, [](auto&, const FieldInfo&) {});
};

namespace detail {

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsMap : std::false_type {};
template <class T>
struct IsMap<std::map<std::string, T>> : std::true_type {};
template <class T>
concept FixedMatrix = std::is_base_of_v<Eigen::MatrixBase<T>, T> && T::SizeAtCompileTime >
0;
template <class T>
struct IsMapEntry : std::false_type {};
template <class T>
requires T::kMapEntry struct IsMapEntry<T> : std::true_type {
};
template <class T>
concept EntryList = IsVector<T>::value && IsMapEntry<typename T::value_type>::value;

template <class T>
void readInto(T& value, const YAML::Node& node, const YamlPlace& place, const FieldInfo& info);

/// Reads all fields of `value`. Checks for unknown keys first, because a missing key may be a misspelt one.
template <class T>
void readFields(T& value, const YAML::Node& node, const YamlPlace& place) {
  if (!node.IsMap()) refuseYaml(node, place, "is not a block of keys", kBlockRemedy);
  std::vector<std::string> known;
  T::visit(value, [&](const auto&, const FieldInfo& info) { known.emplace_back(info.key); });
  refuseUnknownKeys(node, place, known);
  T::visit(value, [&](auto& field, const FieldInfo& info) {
    const std::string key(info.key);
    const YAML::Node child = node[key];
    const YamlPlace inner{place.file, place.key.empty() ? key : place.key + "." + key};
    if (child.IsDefined() && !child.IsNull()) {
      readInto(field, child, inner, info);
    } else if (info.required && !IsOptional<std::remove_reference_t<decltype(field)>>::value) {
      refuseYaml(node, inner, "is missing", "Add it: " + std::string(info.meaning));
    }
  });
}

template <EntryList T>
void readEntries(T& value, const YAML::Node& node, const YamlPlace& place) {
  if (!node.IsMap()) refuseYaml(node, place, "is not a block of keys", kBlockRemedy);
  value.clear();
  for (const auto& entry : node) {
    const std::string key = entry.first.Scalar();
    T::value_type::visit(value.emplace_back(), [&](auto& field, const FieldInfo& info) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, std::string>)
        field = key;
      else
        readInto(field, entry.second, {place.file, place.key + "." + key}, info);
    });
  }
}

template <class T>
void readInto(T& value, const YAML::Node& node, const YamlPlace& place, const FieldInfo& info) {
  if constexpr (Visitable<T>) {
    readFields(value, node, place);
  } else if constexpr (EntryList<T>) {
    readEntries(value, node, place);
  } else if constexpr (IsOptional<T>::value) {
    value.emplace();
    readInto(*value, node, place, info);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!YAML::convert<bool>::decode(node, value))
      refuseYaml(node, place, "is neither true nor false", "Write true or false");
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!node.IsScalar())
      refuseYaml(node, place, "is not a text", "Write one text, in quotes if it has a colon");
    value = node.Scalar();
  } else if constexpr (Named<T>) {
    const auto named = node.IsScalar() ? fromName<T>(node.Scalar()) : std::nullopt;
    std::string names;
    for (const auto& [which, name] : NamesOf<T>::value)
      names += (names.empty() ? "" : ", ") + std::string(name);
    if (!named) refuseYaml(node, place, "is not one of: " + names);
    value = *named;
  } else if constexpr (std::is_integral_v<T>) {
    const double number = yamlNumber(node, place, info);
    if (number != std::floor(number))
      refuseYaml(node, place, "is not a whole number", std::string(info.meaning));
    constexpr double kBeyond = 2.0 * static_cast<double>(std::numeric_limits<T>::max() / 2 + 1);  // exact
    if (number < static_cast<double>(std::numeric_limits<T>::min()) || number >= kBeyond)
      refuseYaml(node, place, "is too large a number", std::string(info.meaning));
    value = static_cast<T>(number);
  } else if constexpr (std::is_floating_point_v<T>) {
    value = yamlNumber(node, place, info);
  } else if constexpr (FixedMatrix<T>) {
    const bool vector = T::ColsAtCompileTime == 1;
    const std::size_t rows = T::RowsAtCompileTime;
    if (!node.IsSequence() || node.size() != rows)
      refuseYaml(node, place, "is not a list of " + std::to_string(rows) + (vector ? " numbers" : " rows"),
                 kListRemedy);
    for (std::size_t row = 0; row < rows; ++row) {
      const YamlPlace inner{place.file, place.key + "[" + std::to_string(row) + "]"};
      if constexpr (T::ColsAtCompileTime == 1) {
        value(static_cast<Eigen::Index>(row)) = yamlNumber(node[row], inner, info);
      } else {
        Eigen::Matrix<double, T::ColsAtCompileTime, 1> line;
        readInto(line, node[row], inner, info);
        value.row(static_cast<Eigen::Index>(row)) = line.transpose();
      }
    }
  } else if constexpr (IsArray<T>::value || IsVector<T>::value) {
    if (!node.IsSequence()) refuseYaml(node, place, "is not a list", kListRemedy);
    if constexpr (IsVector<T>::value)
      value.resize(node.size());
    else if (node.size() != value.size())
      refuseLength(node, place, value.size());
    for (std::size_t i = 0; i < node.size(); ++i)
      readInto(value[i], node[i], {place.file, place.key + "[" + std::to_string(i) + "]"}, info);
  } else {
    static_assert(IsMap<T>::value, "a configuration field of a type that files do not know");
    if (!node.IsMap()) refuseYaml(node, place, "is not a block of keys", kBlockRemedy);
    value.clear();
    for (const auto& entry : node)
      readInto(value[entry.first.Scalar()], entry.second,
               {place.file, place.key + "." + entry.first.Scalar()}, info);
  }
}

/// Whether writing omits the field (an empty optional, or FieldInfo::sparing).
template <class T>
bool isOmitted(const T& field, const FieldInfo& info) {
  if constexpr (IsOptional<T>::value) return !field;
  if constexpr (IsVector<T>::value) return info.sparing && field.empty();
  if constexpr (std::is_enum_v<T>) return info.sparing && field == T{};
  return false;
}

template <class T>
void emitYaml(YAML::Emitter& out, const T& value);

template <EntryList T>
void emitEntries(YAML::Emitter& out, const T& value) {
  out << YAML::BeginMap;
  for (const auto& item : value)
    T::value_type::visit(item, [&](const auto& field, const FieldInfo&) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, std::string>) {
        out << YAML::Key << field << YAML::Value;
      } else {
        emitYaml(out, field);
      }
    });
  out << YAML::EndMap;
}

template <class T>
void emitYaml(YAML::Emitter& out, const T& value) {
  if constexpr (Visitable<T>) {
    out << YAML::BeginMap;
    T::visit(value, [&](const auto& field, const FieldInfo& info) {
      if (isOmitted(field, info)) return;
      out << YAML::Key << std::string(info.key) << YAML::Value;
      emitYaml(out, field);
      if (!info.unit.empty()) out << YAML::Comment(std::string(info.unit));
    });
    out << YAML::EndMap;
  } else if constexpr (IsOptional<T>::value) {
    emitYaml(out, *value);
  } else if constexpr (Named<T>) {
    out << std::string(nameOf(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    out << yamlText(value);
  } else if constexpr (FixedMatrix<T>) {
    out << YAML::Flow << YAML::BeginSeq;
    for (Eigen::Index row = 0; row < value.rows(); ++row) {
      if constexpr (T::ColsAtCompileTime == 1) {
        out << yamlText(value(row));
      } else {
        const Eigen::Matrix<double, T::ColsAtCompileTime, 1> line = value.row(row).transpose();
        emitYaml(out, line);
      }
    }
    out << YAML::EndSeq;
  } else if constexpr (EntryList<T>) {
    emitEntries(out, value);
  } else if constexpr (IsArray<T>::value || IsVector<T>::value) {
    out << YAML::BeginSeq;
    for (const auto& item : value) emitYaml(out, item);
    out << YAML::EndSeq;
  } else if constexpr (IsMap<T>::value) {
    out << YAML::BeginMap;
    for (const auto& [key, item] : value) {
      out << YAML::Key << key << YAML::Value;
      emitYaml(out, item);
    }
    out << YAML::EndMap;
  } else {
    out << value;
  }
}

}  // namespace detail

/// Reads a T from YAML `text`; `file` names it in errors. Throws InputError.
template <Visitable T>
T readYaml(const std::string& text, const std::string& file) {
  T value{};
  detail::readFields(value, parseYamlText(text, file), {file, {}});
  return value;
}

/// Reads a T from the YAML file at `path`. Throws InputError.
template <Visitable T>
T readYamlFile(const std::filesystem::path& path) {
  return readYaml<T>(readYamlTextFile(path), path.string());
}

/// YAML text of `value`, with units as comments. readYaml() of this text gives the same bits back.
template <Visitable T>
std::string writeYaml(const T& value) {
  YAML::Emitter out;
  detail::emitYaml(out, value);
  return std::string(out.c_str()) + "\n";
}

}  // namespace capstan::base
