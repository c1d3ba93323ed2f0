#include "core/vision/hsv_kernel.h"

#if defined(__x86_64__)

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

// 32 pixels at a time, without division. With OpenCV's rounded reciprocals the conditions on hue and
// saturation are
//   60 x − (2 h − 1) diff + e  >= 0,  |e| <= (k + 1) diff² / 4096   (x: difference of the two lesser
//   channels, 255 diff − (s − 1/2) v + e >= 0,  |e| <  8                       h: hue from the centre of
//   sector k / 2)
// where e is the rounding error of the reciprocal. Pixels that are inside or outside by more than e are
// decided with 16-bit integers; HsvThreshold::contains() decides the few others.
#define CAPSTAN_AVX2 __attribute__((target("avx2"))) inline

namespace capstan::vision {

namespace {

struct Pair {
  __m256i sure, maybe;  // lanes certainly inside; lanes not certainly outside
};

struct Channels {
  __m256i b, g, r;
};

CAPSTAN_AVX2 __m256i twoLanes(const std::uint8_t* low, const std::uint8_t* high) {
  return _mm256_inserti128_si256(
      _mm256_castsi128_si256(_mm_loadu_si128(reinterpret_cast<const __m128i*>(low))),
      _mm_loadu_si128(reinterpret_cast<const __m128i*>(high)), 1);
}

/// Byte 3 i + c of the 48 bytes of a lane is at position (3 i + c) mod 16: two blends collect a channel, and
/// a shuffle sorts it.
CAPSTAN_AVX2 Channels loadPixels(const std::uint8_t* p) {
  const __m256i a0 = twoLanes(p, p + 48), a1 = twoLanes(p + 16, p + 64), a2 = twoLanes(p + 32, p + 80);
  const __m256i one =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0));
  const __m256i two =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1, 0));
  const __m256i sort_b =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 3, 6, 9, 12, 15, 2, 5, 8, 11, 14, 1, 4, 7, 10, 13));
  const __m256i sort_g =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(1, 4, 7, 10, 13, 0, 3, 6, 9, 12, 15, 2, 5, 8, 11, 14));
  const __m256i sort_r =
      _mm256_broadcastsi128_si256(_mm_setr_epi8(2, 5, 8, 11, 14, 1, 4, 7, 10, 13, 0, 3, 6, 9, 12, 15));
  return {_mm256_shuffle_epi8(_mm256_blendv_epi8(_mm256_blendv_epi8(a0, a1, two), a2, one), sort_b),
          _mm256_shuffle_epi8(_mm256_blendv_epi8(_mm256_blendv_epi8(a1, a0, one), a2, two), sort_g),
          _mm256_shuffle_epi8(_mm256_blendv_epi8(_mm256_blendv_epi8(a2, a0, two), a1, one), sort_r)};
}

CAPSTAN_AVX2 __m256i widen(__m256i bytes, bool high) {
  const __m256i zero = _mm256_setzero_si256();
  return high ? _mm256_unpackhi_epi8(bytes, zero) : _mm256_unpacklo_epi8(bytes, zero);
}

CAPSTAN_AVX2 Pair saturated(__m256i diff, __m256i v, int low) {
  const __m256i have = _mm256_mullo_epi16(diff, _mm256_set1_epi16(255));
  const __m256i need = _mm256_sub_epi16(_mm256_mullo_epi16(v, _mm256_set1_epi16(static_cast<short>(low))),
                                        _mm256_srli_epi16(v, 1));
  const __m256i margin = _mm256_set1_epi16(9);
  const __m256i more = _mm256_adds_epu16(have, margin), strict = _mm256_adds_epu16(need, margin);
  return {_mm256_cmpeq_epi16(_mm256_max_epu16(have, strict), have),
          _mm256_cmpeq_epi16(_mm256_max_epu16(more, need), more)};
}

CAPSTAN_AVX2 Pair hueInside(__m256i x, __m256i diff, const HsvThreshold::Sector& sector, int k) {
  const __m256i squared = _mm256_mullo_epi16(diff, diff);
  const __m256i one = _mm256_set1_epi16(1);
  const __m256i margin =
      _mm256_add_epi16(_mm256_mulhi_epu16(squared, _mm256_set1_epi16(static_cast<short>(16 * (k + 1)))), one);
  const __m256i minus = _mm256_sub_epi16(_mm256_setzero_si256(), margin);
  const __m256i scaled = _mm256_mullo_epi16(x, _mm256_set1_epi16(60));
  const auto bound = [](int hue) { return static_cast<short>(2 * hue - 1); };
  const __m256i above =
      _mm256_sub_epi16(scaled, _mm256_mullo_epi16(diff, _mm256_set1_epi16(bound(sector.low))));
  const __m256i beyond =
      _mm256_sub_epi16(scaled, _mm256_mullo_epi16(diff, _mm256_set1_epi16(bound(sector.high + 1))));
  const __m256i sure = _mm256_and_si256(_mm256_cmpgt_epi16(above, margin), _mm256_cmpgt_epi16(minus, beyond));
  const __m256i outside =
      _mm256_or_si256(_mm256_cmpgt_epi16(minus, above), _mm256_cmpgt_epi16(beyond, margin));
  const __m256i ones = _mm256_cmpeq_epi16(one, one);
  if (sector.inverted) return {outside, _mm256_andnot_si256(sure, ones)};
  return {sure, _mm256_andnot_si256(outside, ones)};
}

CAPSTAN_AVX2 Pair both(Pair a, Pair b) {
  return {_mm256_and_si256(a.sure, b.sure), _mm256_and_si256(a.maybe, b.maybe)};
}

CAPSTAN_AVX2 Pair narrow(const Pair (&half)[2]) {
  return {_mm256_packs_epi16(half[0].sure, half[1].sure), _mm256_packs_epi16(half[0].maybe, half[1].maybe)};
}

/// Tests 32 pixels for a saturation of at least `low`.
CAPSTAN_AVX2 Pair saturationOf(__m256i diff, __m256i v, int low) {
  const __m256i all = _mm256_set1_epi8(-1);
  if (low <= 0) return {all, all};
  const Pair half[2] = {saturated(widen(diff, false), widen(v, false), low),
                        saturated(widen(diff, true), widen(v, true), low)};
  return narrow(half);
}

/// Tests 32 pixels for a hue in range. in[k]: whether a pixel belongs to sector k, which has a hue in range.
CAPSTAN_AVX2 Pair hueOf(const Channels& c, __m256i diff, const __m256i (&in)[3],
                        const std::array<HsvThreshold::Sector, 3>& sectors) {
  Pair hue{_mm256_setzero_si256(), _mm256_setzero_si256()};
  for (int k = 0; k < 3; ++k) {
    if (!sectors[k].active) continue;
    const __m256i from = k == 0 ? c.g : k == 1 ? c.b : c.r, less = k == 0 ? c.b : k == 1 ? c.r : c.g;
    Pair half[2];
    for (int high = 0; high < 2; ++high)
      half[high] = hueInside(_mm256_sub_epi16(widen(from, high != 0), widen(less, high != 0)),
                             widen(diff, high != 0), sectors[k], 2 * k);
    const Pair here = both(narrow(half), {in[k], in[k]});
    hue = {_mm256_or_si256(hue.sure, here.sure), _mm256_or_si256(hue.maybe, here.maybe)};
  }
  return hue;
}

}  // namespace

bool HsvKernel::hasAvx2() { return __builtin_cpu_supports("avx2") != 0; }

__attribute__((target("avx2"))) std::uint64_t HsvKernel::avx2Row(const HsvThreshold& test,
                                                                 const std::uint8_t* bgr, int width,
                                                                 std::uint64_t* bits) {
  const __m256i value_low = _mm256_set1_epi8(static_cast<char>(test.value_low_));
  const __m256i allow[3] = {_mm256_set1_epi8(test.sectors_[0].active ? -1 : 0),
                            _mm256_set1_epi8(test.sectors_[1].active ? -1 : 0),
                            _mm256_set1_epi8(test.sectors_[2].active ? -1 : 0)};
  std::uint64_t any = 0;
  const std::ptrdiff_t blocks = width / 32;
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    const std::uint8_t* pixels = bgr + 96 * block;
    const Channels c = loadPixels(pixels);
    const __m256i v = _mm256_max_epu8(_mm256_max_epu8(c.b, c.g), c.r);
    const __m256i diff = _mm256_sub_epi8(v, _mm256_min_epu8(_mm256_min_epu8(c.b, c.g), c.r));
    const __m256i is_red = _mm256_cmpeq_epi8(v, c.r);
    const __m256i is_green = _mm256_andnot_si256(is_red, _mm256_cmpeq_epi8(v, c.g));
    const __m256i is_blue = _mm256_andnot_si256(_mm256_or_si256(is_red, is_green), _mm256_set1_epi8(-1));
    const __m256i in[3] = {_mm256_and_si256(is_red, allow[0]), _mm256_and_si256(is_green, allow[1]),
                           _mm256_and_si256(is_blue, allow[2])};
    const __m256i candidate = _mm256_and_si256(_mm256_cmpeq_epi8(_mm256_max_epu8(v, value_low), v),
                                               _mm256_or_si256(_mm256_or_si256(in[0], in[1]), in[2]));
    std::uint32_t found = 0;
    if (!_mm256_testz_si256(candidate, candidate)) {
      const Pair coloured = both(saturationOf(diff, v, test.saturation_low_), {candidate, candidate});
      if (!_mm256_testz_si256(coloured.maybe, coloured.maybe)) {
        const Pair inside = both(coloured, hueOf(c, diff, in, test.sectors_));
        found = static_cast<std::uint32_t>(_mm256_movemask_epi8(inside.sure));
        std::uint32_t open = static_cast<std::uint32_t>(_mm256_movemask_epi8(inside.maybe)) & ~found;
        for (; open != 0; open &= open - 1) {
          const std::ptrdiff_t i = std::countr_zero(open);
          const std::uint8_t* p = pixels + 3 * i;
          found |= std::uint32_t{test.contains(p[0], p[1], p[2])} << i;
        }
      }
    }
    std::memcpy(reinterpret_cast<char*>(bits) + 4 * block, &found, 4);
    any |= found;
  }
  const std::ptrdiff_t rest = 32 * blocks;
  std::uint64_t tail = 0;
  for (std::ptrdiff_t x = rest; x < width; ++x) {
    const std::uint8_t* p = bgr + 3 * x;
    tail |= std::uint64_t{test.contains(p[0], p[1], p[2])} << (x - rest);
  }
  if (rest % 64 != 0) {
    bits[rest / 64] = (bits[rest / 64] & 0xffffffffULL) | tail << 32;
  } else if (rest < width) {
    bits[rest / 64] = tail;
  }
  return any | tail;
}

}  // namespace capstan::vision

#else

namespace capstan::vision {

bool HsvKernel::hasAvx2() { return false; }

std::uint64_t HsvKernel::avx2Row(const HsvThreshold& test, const std::uint8_t* bgr, int width,
                                 std::uint64_t* bits) {
  return portableRow(test, bgr, width, bits);
}

}  // namespace capstan::vision

#endif
