#include "core/learning/model/correction_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/checksum.h"
#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/base/yaml.h"
#include "core/learning/model/correction_check.h"

namespace capstan::learning {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Json = nlohmann::json;
using learning::CorrectionParts;
using learning::SparseProcessParts;

static_assert(std::endian::native == std::endian::little, "numbers are written as they stand in memory");

constexpr std::string_view kMagic = "capstan correction ";
constexpr int kVersion = 3;

[[noreturn]] void refuse(const std::filesystem::path& path, std::string what, std::string remedy) {
  throw base::InputError({path.string(), 0, {}, {}, std::move(what), std::move(remedy)});
}

/// Sequence of the numbers in a file.
class Numbers {
 public:
  explicit Numbers(std::string bytes = {}) : bytes_(std::move(bytes)) {}

  void put(double x) { bytes_.append(reinterpret_cast<const char*>(&x), sizeof x); }
  void put(const MatrixXd& x) {
    bytes_.append(reinterpret_cast<const char*>(x.data()),
                  static_cast<std::size_t>(x.size()) * sizeof(double));
  }
  void putLower(const MatrixXd& x) {
    for (Index c = 0; c < x.cols(); ++c) put(MatrixXd(x.col(c).tail(x.rows() - c)));
  }

  /// Throws std::out_of_range if there are fewer numbers.
  MatrixXd take(Index rows, Index columns = 1) {
    if (columns > left() || rows > left() / std::max<Index>(columns, 1)) throw std::out_of_range("numbers");
    const std::size_t size = static_cast<std::size_t>(rows * columns) * sizeof(double);
    MatrixXd x(rows, columns);
    std::memcpy(x.data(), bytes_.data() + at_, size);
    at_ += size;
    return x;
  }
  double take() { return take(1)(0, 0); }
  MatrixXd takeLower(Index n) {
    if (n > left() || n * (n + 1) / 2 > left()) throw std::out_of_range("numbers");  // before memory for them
    MatrixXd x = MatrixXd::Zero(n, n);
    for (Index c = 0; c < n; ++c) x.col(c).tail(n - c) = take(n - c);
    return x;
  }

  /// Number of numbers that are not taken.
  Index left() const { return static_cast<Index>((bytes_.size() - at_) / sizeof(double)); }
  const std::string& bytes() const { return bytes_; }
  bool allTaken() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

void put(const CorrectionParts& parts, Numbers& to) {
  to.put(parts.offset.matrix());
  to.put(parts.features.middle().coeffs());
  to.put(parts.lever);
  to.put(parts.workspace.min());
  to.put(parts.workspace.max());
  to.put(parts.turns.min());
  to.put(parts.turns.max());
  for (const Eigen::RowVectorXd* row : {&parts.middle, &parts.deviation, &parts.scale, &parts.inflation})
    to.put(*row);
  for (const std::vector<SparseProcessParts>& group : parts.groups)
    for (const SparseProcessParts& member : group) {
      to.put(member.parameters.packed());
      to.put(member.inducing);
      to.putLower(member.square);
      to.put(member.sum);
    }
}

Json headerOf(const CorrectionParts& parts, const CorrectionSource& source) {
  Json groups = Json::array();
  for (const std::vector<SparseProcessParts>& group : parts.groups) {
    groups.push_back(Json::array());
    for (const SparseProcessParts& member : group)
      groups.back().push_back({{"kernel", base::nameOf(member.parameters.kernel)},
                               {"inducing", member.inducing.rows()},
                               {"lengths", member.parameters.ln_length.size()},
                               {"outputs", member.sum.cols()}});
  }
  return {{"rotation", base::nameOf(parts.features.form())},
          {"motion", base::nameOf(parts.features.motion())},
          {"groups", std::move(groups)},
          {"source",
           {{"files", source.files},
            {"checksums", source.checksums},
            {"towards", base::nameOf(source.towards)},
            {"lag", source.clock_offset},
            {"states", source.states},
            {"rejected", source.rejected},
            {"software", source.software}}}};
}

template <class T>
T named(const Json& json) {
  const auto value = base::fromName<T>(json.get<std::string>());
  if (!value) throw std::out_of_range(json.get<std::string>());
  return *value;
}

/// A count. A number that is none would be converted to any other.
Index countFrom(const Json& json) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40U;
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > kMost) throw std::out_of_range("a count");
  return json.get<Index>();
}

CorrectionSource sourceFrom(const Json& json) {
  return {json.at("files"),
          json.at("checksums"),
          named<learning::StreamKind>(json.at("towards")),
          json.at("lag"),
          static_cast<std::size_t>(countFrom(json.at("states"))),
          static_cast<std::size_t>(countFrom(json.at("rejected"))),
          json.at("software")};
}

SparseProcessParts memberFrom(const Json& json, Index features, Numbers& from) {
  const Index inducing = countFrom(json.at("inducing")), lengths = countFrom(json.at("lengths")),
              outputs = countFrom(json.at("outputs"));
  if (inducing < 1 || outputs < 1 || (lengths != 1 && lengths != features)) throw std::out_of_range("groups");
  SparseProcessParts member;
  member.parameters = learning::KernelParameters::unpacked(from.take(2 + lengths),
                                                           named<learning::Kernel>(json.at("kernel")));
  member.inducing = from.take(inducing, features);
  member.square = from.takeLower(inducing);
  member.sum = from.take(inducing, outputs);
  return member;
}

CorrectionParts partsFrom(const Json& header, Numbers& from) {
  CorrectionParts parts;
  parts.offset.matrix() = from.take(4, 4);
  const Eigen::Vector4d middle = from.take(4);
  parts.features = {named<learning::RotationForm>(header.at("rotation")),
                    named<learning::Motion>(header.at("motion")), Eigen::Quaterniond(middle)};
  parts.lever = from.take();
  parts.workspace.min() = from.take(3);
  parts.workspace.max() = from.take(3);
  parts.turns.min() = from.take(3);
  parts.turns.max() = from.take(3);
  const Index features = parts.features.size(), outputs = 6;
  parts.middle = from.take(1, features);
  parts.deviation = from.take(1, features);
  parts.scale = from.take(1, outputs);
  parts.inflation = from.take(1, outputs);
  for (const Json& group : header.at("groups")) {
    if (group.empty()) throw std::out_of_range("groups");
    parts.groups.emplace_back();
    for (const Json& member : group) parts.groups.back().push_back(memberFrom(member, features, from));
  }
  return parts;
}

/// Parses the second line; nothing for other text, and for deeply nested one, which would exhaust the stack.
Json parsedHeader(const std::string& line) {
  constexpr int kDeepest = 16;
  const auto within = [](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) throw std::out_of_range("depth");
    return true;
  };
  try {
    return Json::parse(line, within, false);
  } catch (const std::out_of_range&) {
    return {};
  }
}

/// Returns the next line of `text` and removes it from there.
std::string lineOff(std::string& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string line = text.substr(0, end);
  text.erase(0, end + 1);
  return line;
}

void checkVersion(const std::string& line, const std::filesystem::path& path) {
  if (!line.starts_with(kMagic))
    refuse(path, "is no model of a correction", "Give a file that `capstan-cli learn --model` wrote");
  const std::string version = line.substr(kMagic.size());
  if (version != std::to_string(kVersion))
    refuse(path, fmt::format("is a model of version {}; this program reads version {}", version, kVersion),
           "Read it with the program version that wrote it, or learn the model again");
}

}  // namespace

void writeCorrection(const CorrectionFile& file, const std::filesystem::path& path) {
  const CorrectionParts parts = file.model.parts();
  Numbers numbers;
  put(parts, numbers);
  Json header = headerOf(parts, file.source);
  header["numbers"] = numbers.bytes().size() / sizeof(double);
  header["checksum"] = base::checksumOf(header.dump() + numbers.bytes());
  base::checkWritable(path);
  base::PartFile part(path);
  std::ofstream out(part.path(), std::ios::binary);
  out << kMagic << kVersion << '\n' << header.dump() << '\n' << numbers.bytes();
  out.close();
  if (!out) refuse(path, "cannot be written", "Check the space on its disk");
  part.commit();
}

CorrectionFile readCorrection(const std::filesystem::path& path) {
  std::string text = base::readTextFile(path);
  checkVersion(lineOff(text), path);
  constexpr const char* kRemedy = "Copy the original file again, or learn the model again";
  Json header = parsedHeader(lineOff(text));
  if (!header.is_object() || !header.contains("checksum") || !header.contains("numbers"))
    refuse(path, "has a damaged second line", kRemedy);
  const Json checksum = header["checksum"];
  header.erase("checksum");
  if (header["numbers"] != text.size() / sizeof(double) || text.size() % sizeof(double) != 0)
    refuse(path,
           fmt::format("holds {} of {} numbers", text.size() / sizeof(double), header["numbers"].dump()),
           kRemedy);
  if (checksum != base::checksumOf(header.dump() + text))
    refuse(path, "does not match its checksum", kRemedy);
  try {
    Numbers numbers(std::move(text));
    CorrectionParts parts = partsFrom(header, numbers);
    checkParts(parts);
    if (!numbers.allTaken()) refuse(path, "holds more numbers than its model has", kRemedy);
    return {learning::CorrectionModel(std::move(parts)), sourceFrom(header.at("source"))};
  } catch (const Json::exception& error) {
    refuse(path, fmt::format("says what no model says ({})", error.what()), kRemedy);
  } catch (const std::out_of_range& error) {
    refuse(path, fmt::format("says what no model says ({})", error.what()), kRemedy);
  }
}

}  // namespace capstan::learning
