#include "core/ros1/raven_state.h"

#include <charconv>
#include <cstring>
#include <map>
#include <sstream>

#include "core/base/error.h"
#include "core/ros1/stamp.h"

namespace capstan::ros1 {
namespace {

const std::map<std::string, std::size_t, std::less<>> kSizes = {
    {"bool", 1},  {"int8", 1},   {"uint8", 1},   {"byte", 1},   {"char", 1},
    {"int16", 2}, {"uint16", 2}, {"int32", 4},   {"uint32", 4}, {"float32", 4},
    {"int64", 8}, {"uint64", 8}, {"float64", 8}, {"time", 8},   {"duration", 8}};

[[noreturn]] void refuse(const std::string& field, const std::string& reason) {
  throw base::InputError(
      {{}, 0, field, {}, reason, "Check that the topic is the ravenstate of a RAVEN-II's own software"});
}

constexpr std::size_t kMostEntries = 4096;  // of a field; more is damage

/// Size in bytes of a field of the type `type`, as float32[16]; 0: the type is not one of fixed length.
std::size_t sizeOf(const std::string& type) {
  const std::size_t bracket = type.find('[');
  const auto one = kSizes.find(type.substr(0, bracket));
  if (one == kSizes.end()) return 0;
  if (bracket == std::string::npos) return one->second;
  std::size_t count = 0;
  const char* const end = type.data() + type.size();
  const auto [at, fault] = std::from_chars(type.data() + bracket + 1, end, count);
  const bool whole = fault == std::errc() && at + 1 == end && *at == ']';
  return whole && count <= kMostEntries ? one->second * count : 0;
}

template <class T>
T numberAt(const Bytes& bytes, std::size_t at) {
  if (sizeof(T) > bytes.size() || at > bytes.size() - sizeof(T)) refuse("raven_state", "ends too early");
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::array<float, 16> entriesAt(const Bytes& bytes, std::size_t at) {
  std::array<float, 16> entries;
  for (std::size_t k = 0; k < entries.size(); ++k) entries[k] = numberAt<float>(bytes, at + 4 * k);
  return entries;
}

}  // namespace

const char* const RavenStateLayout::kDefinition = R"(Header hdr
int32 runlevel
int32 sublevel
int32 last_seq
int32[2] type
int32[6] pos
float32[18] ori
float32[18] ori_d
int32[6] pos_d
duration dt
int32[16] encVals
float32[16] tau
float32[16] mpos
float32[16] jpos
float32[16] mvel
float32[16] jvel
float32[16] mpos_d
float32[16] jpos_d
float32[2] grasp_d
float32[16] encoffsets
)";

bool isRavenState(const std::string& type) {
  return type == "raven_state" ||
         (type.size() > 12 && type.compare(type.size() - 12, 12, "/raven_state") == 0);
}

RavenStateLayout::RavenStateLayout(const std::string& definition) {
  std::map<std::string, std::size_t*, std::less<>> wanted = {
      {"tau", &tau_}, {"mpos", &mpos_}, {"jpos", &jpos_}, {"mvel", &mvel_}};
  std::istringstream lines(definition);
  std::size_t at = 0;
  bool header = false;
  for (std::string line; !wanted.empty() && std::getline(lines, line);) {
    if (line.starts_with("===")) break;  // definitions of the parts follow
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type, name;
    if (!(words >> type >> name) || line.find('=') != std::string::npos) continue;
    if (!header) {
      if (type != "Header" && type != "std_msgs/Header")
        refuse(name, "comes before the header of the message");
      header = true;
      continue;
    }
    if (const auto found = wanted.find(name); found != wanted.end()) {
      if (type != "float32[16]") refuse(name, "is " + type + " in the message's definition, not float32[16]");
      *found->second = at;
      wanted.erase(found);
    }
    const std::size_t size = sizeOf(type);
    if (size == 0) refuse(name, "has a variable length in the message's definition");
    at += size;
  }
  if (!wanted.empty()) refuse(wanted.begin()->first, "is missing in the message's definition");
}

RavenState RavenStateLayout::read(const Bytes& bytes) const {
  RavenState state;
  state.stamp = numberAt<std::uint32_t>(bytes, 4) * kSecond + numberAt<std::uint32_t>(bytes, 8);
  const std::size_t body = 16 + numberAt<std::uint32_t>(bytes, 12);  // seq, sec, nsec, frame
  state.tau = entriesAt(bytes, body + tau_), state.mpos = entriesAt(bytes, body + mpos_);
  state.jpos = entriesAt(bytes, body + jpos_), state.mvel = entriesAt(bytes, body + mvel_);
  return state;
}

}  // namespace capstan::ros1
