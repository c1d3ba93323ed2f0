#include "tests/support/mutated_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace capstan::testing {
namespace {

using Text = std::string;

std::size_t below(base::Random& random, std::size_t end) {
  return random.bits() % std::max<std::size_t>(end, 1);
}

Text randomBytes(base::Random& random, std::size_t count) {
  Text bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.bits());
  return bytes;
}

/// Begin and end of a random cell, the header's included.
std::pair<std::size_t, std::size_t> someCell(const Text& text, base::Random& random) {
  const std::size_t at = below(random, text.size() - 1);
  std::size_t begin = text.find_last_of(",\n", at), end = text.find_first_of(",\n", at + 1);
  begin = begin == Text::npos ? 0 : begin + 1;
  end = end == Text::npos ? text.size() : end;
  return {std::min(begin, end), end};
}

void replaceCell(Text& text, base::Random& random, const Text& cell) {
  const auto [begin, end] = someCell(text, random);
  text.replace(begin, end - begin, cell);
}

/// A random line, the header's included, is replaced by `change` of itself.
template <class Change>
void changeLine(Text& text, base::Random& random, Change&& change) {
  const std::size_t at = below(random, text.size() - 1);
  const std::size_t before = at == 0 ? Text::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == Text::npos ? 0 : before + 1, end = text.find('\n', at);
  text.replace(begin, end - begin, change(text.substr(begin, end - begin)));
}

void cut(Text& text, base::Random& random) { text.resize(below(random, text.size())); }

void flip(Text& text, base::Random& random) {
  for (std::size_t k = 1 + below(random, 20); k > 0; --k)
    text[below(random, text.size())] ^= static_cast<char>(1 << below(random, 8));
}

void notFinite(Text& text, base::Random& random) {
  constexpr std::array kCells = {"nan",       "NaN",   "inf",    "-inf",  "1e999",
                                 "-nan(0x7)", "1e308", "-1e308", "5e-324"};
  for (std::size_t k = 1 + below(random, 4); k > 0; --k)
    replaceCell(text, random, kCells[below(random, kCells.size())]);
}

void hugeLine(Text& text, base::Random& random) {
  replaceCell(text, random, Text(std::size_t{1} << (12 + below(random, 9)), "7,a\0"[below(random, 4)]));
}

void nul(Text& text, base::Random& random) {
  for (std::size_t k = 1 + below(random, 50); k > 0; --k) text.insert(below(random, text.size()), 1, '\0');
}

void binary(Text& text, base::Random& random) {
  const Text bytes = randomBytes(random, 1 + below(random, 1U << 15));
  const std::size_t at = random.bits() % 2 == 0 ? 0 : below(random, text.size());
  text = text.substr(0, at) + bytes + text.substr(at);
}

void columns(Text& text, base::Random& random) {
  const std::size_t count = std::size_t{1} << below(random, 14);
  changeLine(text, random, [&](Text line) {
    for (std::size_t k = 0; k < count; ++k) line += fmt::format(",{}", random.bits() % 2 == 0 ? k : 0);
    return line;
  });
}

void backwards(Text& text, base::Random& random) {
  constexpr std::array kTimes = {-1e300, -1e18, -1e9, -3.0, -0.2, -1e-3, 0.0, 0.01, 10.0, 1e9, 1e18, 1e300};
  changeLine(text, random, [&](const Text& line) {
    const std::size_t comma = line.find(',');
    return fmt::format("{}{}", kTimes[below(random, kTimes.size())],
                       comma == Text::npos ? Text() : line.substr(comma));
  });
}

void lines(Text& text, base::Random& random) {
  const Text repeated(1 + below(random, 1U << 14), random.bits() % 2 == 0 ? '\n' : '\r');
  text.insert(below(random, text.size()), repeated);
}

void swapped(Text& text, base::Random& random) {
  Text other = text;
  changeLine(text, random, [&](const Text& line) {
    changeLine(other, random, [&](const Text& with) { return line + "\n" + with; });
    return other.substr(0, below(random, other.size()));
  });
}

void stranger(Text& text, base::Random& random) {
  constexpr std::array kHellos = {"GET / HTTP/1.1\r\nHost: robot\r\n\r\n",
                                  "SSH-2.0-OpenSSH_9.2\r\n",
                                  "\x16\x03\x01\x02",
                                  "{\"op\": \"subscribe\"}\n",
                                  "",
                                  "\n",
                                  "t\n",
                                  ",,,,\n,,,,\n",
                                  "t,q_m1,q_m1,q_m2\n",
                                  "\xef\xbb\xbft,q_m1,q_m2,q_m3\n"};
  text = kHellos[below(random, kHellos.size())] + Text(below(random, 200), '\n');
}

void drip(Text& text, base::Random& random) {
  text.resize(std::min<std::size_t>(text.size(), 400));
  flip(text, random);
}

struct Mutation {
  const char* kind;
  void (*change)(Text&, base::Random&);
};
constexpr std::array kMutations = {Mutation{"cut", cut},
                                   Mutation{"bit flips", flip},
                                   Mutation{"nan, inf, huge", notFinite},
                                   Mutation{"huge line", hugeLine},
                                   Mutation{"NUL", nul},
                                   Mutation{"binary", binary},
                                   Mutation{"columns", columns},
                                   Mutation{"time jumps", backwards},
                                   Mutation{"line ends", lines},
                                   Mutation{"line in a line", swapped},
                                   Mutation{"another protocol", stranger},
                                   Mutation{"slow drip", drip}};

}  // namespace

const std::vector<std::string>& mutationKinds() {
  static const std::vector<std::string> kKinds = [] {
    std::vector<std::string> kinds;
    for (const Mutation& mutation : kMutations) kinds.emplace_back(mutation.kind);
    return kinds;
  }();
  return kKinds;
}

std::string validRows(int rows) {
  std::string text = "t,q_m1,q_m2,q_m3,q1,q2,q3,dq_m1,dq_m2,dq_m3\n";
  for (int k = 0; k < rows; ++k) {
    const double t = 1e-3 * k;
    text += fmt::format("{:.6g},{:.9g},{:.9g},{:.9g},{:.9g},1.5,0.34,{:.9g},0,1\n", t, 80.0 + std::sin(t),
                        -90.0 + std::cos(t), -480.0 + t, 1.0 + 0.01 * t, std::cos(t));
  }
  return text;
}

MutatedStream mutatedStream(std::size_t index, base::Random& random) {
  const Mutation& mutation = kMutations[index % kMutations.size()];
  std::string text = validRows(40 + static_cast<int>(below(random, 120)));
  mutation.change(text, random);
  MutatedStream stream{mutation.kind, {}};
  const std::size_t piece =
      mutation.change == drip ? 1 + below(random, 30) : std::max<std::size_t>(text.size(), 1);
  for (std::size_t at = 0; at < text.size(); at += piece) stream.pieces.push_back(text.substr(at, piece));
  return stream;
}

}  // namespace capstan::testing
