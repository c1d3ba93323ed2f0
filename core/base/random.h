#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace capstan::base {

/// Seeded source of random numbers. The same seed and stream name give the same numbers. Streams of one seed
/// are independent: an additional draw from one stream, for example image noise, does not change the numbers
/// of another one, for example encoder jitter.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::string_view stream = {}) : engine_(mix(seed, stream)) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double normal(double mean = 0.0, double sigma = 1.0) { return mean + sigma * standard_(engine_); }
  std::uint64_t bits() { return engine_(); }
  std::mt19937_64& engine() { return engine_; }

 private:
  static std::uint64_t mix(std::uint64_t seed, std::string_view stream) {
    std::uint64_t hash =
        0xcbf29ce484222325ULL ^ (seed * 0x9e3779b97f4a7c15ULL);  // FNV-1a over the stream's name
    for (const char c : stream) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    return hash;
  }

  std::mt19937_64 engine_;
  std::normal_distribution<double> standard_;
};

}  // namespace capstan::base
