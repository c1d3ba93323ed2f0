#include <algorithm>
#include <array>

#include "core/vision/bit_image.h"

// Every loop over words has a multiple of four iterations, so that it is vectorised completely. Words beyond
// the image have no meaning; fillBeyond() sets those that a filter reads. The bodies are compiled twice, with
// and without AVX2.
#if defined(__x86_64__)
#define CAPSTAN_WIDE __attribute__((target("avx2")))
#else
#define CAPSTAN_WIDE
#endif
#define CAPSTAN_BODY __attribute__((always_inline)) inline

namespace capstan::vision {

namespace {

using Word = std::uint64_t;

bool hasAvx2() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
#else
  return false;
#endif
}

CAPSTAN_BODY Word majority(Word a, Word b, Word c) { return (a & b) | (c & (a | b)); }

/// Number of set pixels among five neighbours of a row, 0…5, as three bit planes.
CAPSTAN_BODY void sumFive(const Word* __restrict row, std::size_t words, Word* __restrict ones,
                          Word* __restrict twos, Word* __restrict fours) {
  for (std::size_t i = 0; i < words; ++i) {
    const Word here = row[i], before = row[static_cast<std::ptrdiff_t>(i) - 1], after = row[i + 1];
    const Word a = here << 2 | before >> 62, b = here << 1 | before >> 63;
    const Word d = here >> 1 | after << 63, e = here >> 2 | after << 62;
    const Word sum = a ^ b ^ here, carry = majority(a, b, here), carry2 = majority(sum, d, e);
    ones[i] = sum ^ d ^ e;
    twos[i] = carry ^ carry2;
    fours[i] = carry & carry2;
  }
}

/// Adds the planes of five rows. Whether the number of set pixels, 0…25, is at least 13.
CAPSTAN_BODY void atLeastThirteen(const std::array<const Word*, 5>& p, std::size_t words, std::size_t plane,
                                  Word* __restrict result) {
  const Word* __restrict p0 = p[0], * __restrict p1 = p[1], * __restrict p2 = p[2], * __restrict p3 = p[3], * __restrict p4 = p[4];
  for (std::size_t i = 0; i < words; ++i) {
    const Word s1 = p0[i] ^ p1[i] ^ p2[i], c1 = majority(p0[i], p1[i], p2[i]);
    const Word ones = s1 ^ p3[i] ^ p4[i], c2 = majority(s1, p3[i], p4[i]);
    const std::size_t j = i + plane;  // twos: five and two carries
    const Word s3 = p0[j] ^ p1[j] ^ p2[j], c3 = majority(p0[j], p1[j], p2[j]);
    const Word s4 = p3[j] ^ p4[j] ^ c1, c4 = majority(p3[j], p4[j], c1);
    const Word twos = s3 ^ s4 ^ c2, c5 = majority(s3, s4, c2);
    const std::size_t k = j + plane;  // fours: five and three carries
    const Word s6 = p0[k] ^ p1[k] ^ p2[k], c6 = majority(p0[k], p1[k], p2[k]);
    const Word s7 = p3[k] ^ p4[k] ^ c3, c7 = majority(p3[k], p4[k], c3);
    const Word s8 = s6 ^ s7 ^ c4, c8 = majority(s6, s7, c4);
    const Word fours = s8 ^ c5, c9 = s8 & c5;
    // total = ones + 2 twos + 4 fours + 8 eights, eights = c6 + c7 + c8 + c9
    const Word some = c6 | c7 | c8 | c9;
    const Word sixteen = majority(c6, c7, c8) | (c9 & (c6 | c7 | c8));
    result[i] = sixteen | (some & fours & (ones | twos));
  }
}

struct Rows3 {
  const Word *up, *here, *down;
};

CAPSTAN_BODY void erodeRow(const Rows3& s, std::size_t words, Word* __restrict result) {
  const Word* __restrict up = s.up, * __restrict here = s.here, * __restrict down = s.down;
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(words); ++i) {
    const Word before = up[i - 1] & here[i - 1] & down[i - 1], after = up[i + 1] & here[i + 1] & down[i + 1];
    const Word column = up[i] & here[i] & down[i];
    result[i] = column & (column << 1 | before >> 63) & (column >> 1 | after << 63);
  }
}

CAPSTAN_BODY void dilateRow(const Rows3& s, std::size_t words, Word* __restrict result) {
  const Word* __restrict up = s.up, * __restrict here = s.here, * __restrict down = s.down;
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(words); ++i) {
    const Word before = up[i - 1] | here[i - 1] | down[i - 1], after = up[i + 1] | here[i + 1] | down[i + 1];
    const Word column = up[i] | here[i] | down[i];
    result[i] = column | (column << 1 | before >> 63) | (column >> 1 | after << 63);
  }
}

CAPSTAN_BODY void medianRows(BitImage& source, RowSpan rows, RowSpan out, MedianScratch& scratch,
                             BitImage& result) {
  const std::size_t words = source.paddedWords();
  Word* const planes = scratch.planes.data();  // 3 planes per row; the last row is for empty rows
  Word* const empty = planes + 3 * words * static_cast<std::size_t>(rows.last - rows.first + 1);
  std::fill_n(empty, 3 * words, Word{0});
  for (int y = rows.first; y <= rows.last; ++y) {
    source.fillBeyond(y, source.at(0, y), source.at(source.width() - 1, y));
    Word* const to = planes + 3 * words * static_cast<std::size_t>(y - rows.first);
    sumFive(source.row(y), words, to, to + words, to + 2 * words);
  }
  for (int y = out.first; y <= out.last; ++y) {
    std::array<const Word*, 5> p;
    for (int k = 0; k < 5; ++k) {
      const int from = std::clamp(y + k - 2, 0, source.height() - 1);
      p[k] = from < rows.first || from > rows.last
                 ? empty
                 : planes + 3 * words * static_cast<std::size_t>(from - rows.first);
    }
    atLeastThirteen(p, words, words, result.row(y));
  }
}

CAPSTAN_BODY void erodeRows(BitImage& source, RowSpan rows, RowSpan out, BitImage& result) {
  for (int y = rows.first; y <= rows.last; ++y) source.fillBeyond(y, true, true);
  for (int y = out.first; y <= out.last; ++y)
    erodeRow({source.row(std::max(y - 1, rows.first)), source.row(y), source.row(std::min(y + 1, rows.last))},
             source.paddedWords(), result.row(y));
}

CAPSTAN_BODY void dilateRows(BitImage& source, RowSpan rows, RowSpan out, BitImage& result) {
  for (int y = rows.first; y <= rows.last; ++y) source.fillBeyond(y, false, false);
  for (int y = out.first; y <= out.last; ++y) {
    const auto nearest = [&](int at) { return source.row(std::clamp(at, rows.first, rows.last)); };
    dilateRow({nearest(y - 1), nearest(y), nearest(y + 1)}, source.paddedWords(), result.row(y));
  }
  for (int y = out.first; y <= out.last; ++y) result.fillBeyond(y, false, false);
}

CAPSTAN_WIDE void medianWide(BitImage& s, RowSpan r, RowSpan o, MedianScratch& m, BitImage& t) {
  medianRows(s, r, o, m, t);
}
CAPSTAN_WIDE void erodeWide(BitImage& s, RowSpan r, RowSpan o, BitImage& t) { erodeRows(s, r, o, t); }
CAPSTAN_WIDE void dilateWide(BitImage& s, RowSpan r, RowSpan o, BitImage& t) { dilateRows(s, r, o, t); }

}  // namespace

RowSpan median5x5(BitImage& source, RowSpan rows, MedianScratch& scratch, BitImage& result) {
  result.resize(source.width(), source.height());
  if (rows.empty()) return {};
  const RowSpan out = rows.grown(2, source.height());
  if (hasAvx2())
    medianWide(source, rows, out, scratch, result);
  else
    medianRows(source, rows, out, scratch, result);
  return out;
}

RowSpan erode3x3(BitImage& source, RowSpan rows, BitImage& result) {
  result.resize(source.width(), source.height());
  if (rows.empty()) return {};
  const RowSpan out{rows.first == 0 ? 0 : rows.first + 1,
                    rows.last == source.height() - 1 ? rows.last : rows.last - 1};
  if (out.empty()) return {};
  if (hasAvx2())
    erodeWide(source, rows, out, result);
  else
    erodeRows(source, rows, out, result);
  return out;
}

RowSpan dilate3x3(BitImage& source, RowSpan rows, BitImage& result) {
  result.resize(source.width(), source.height());
  if (rows.empty()) return {};
  const RowSpan out = rows.grown(1, source.height());
  if (hasAvx2())
    dilateWide(source, rows, out, result);
  else
    dilateRows(source, rows, out, result);
  return out;
}

}  // namespace capstan::vision
