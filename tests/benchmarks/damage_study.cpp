// damage_study [--truncations 1000] [--flips 1000] [--every-byte] [--seed 1]: damages copies of a session of
// about 1 MB and says what came of them: opened with every sample as it was written, refused, or recovered.
// Exit code 1 if a sample was read or saved with another value.
#include <CLI/CLI.hpp>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "core/base/error.h"
#include "core/recording/recover.h"
#include "core/recording/session_source.h"
#include "core/recording/session_writer.h"
#include "tests/core/recording/session_samples.h"

namespace {

using namespace capstan;
using namespace capstan::recording;
namespace fs = std::filesystem;

/// Digest of every sample, by the order of arrival of its kind and time.
using Samples = std::multimap<std::pair<std::size_t, double>, std::size_t>;

std::size_t digestOf(const tracking::Sample& sample) {
  std::ostringstream text;
  const auto put = [&](const Eigen::Vector3d& v) {
    for (const double x : {v.x(), v.y(), v.z()})
      text << (x != x ? 0 : std::bit_cast<std::uint64_t>(x)) << ' ';
  };
  if (const auto* motor = std::get_if<tracking::MotorSample>(&sample))
    put(motor->position), put(motor->velocity), put(motor->torque);
  if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) put(joint->position);
  if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) put(tip->position);
  if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample))
    for (const cv::Mat& image : {frame->left, frame->right})
      text.write(reinterpret_cast<const char*>(image.data),
                 image.empty() ? 0 : static_cast<std::streamsize>(image.total() * image.elemSize()));
  return std::hash<std::string>{}(text.str());
}

/// Samples of a session. `refused`: it was refused, or became unreadable on the way.
Samples samplesOf(const fs::path& path, bool& refused) {
  Samples samples;
  refused = false;
  try {
    SessionSource source(path);
    for (tracking::Sample sample; source.next(sample);) {
      const double t = std::visit([](const auto& one) { return one.t; }, sample);
      samples.emplace(std::pair{sample.index(), t}, digestOf(sample));
    }
  } catch (const base::InputError&) {
    refused = true;
  }
  return samples;
}

/// Whether every sample is one of `all`.
bool within(const Samples& samples, const Samples& all) {
  for (const auto& [key, digest] : samples) {
    const auto [first, last] = all.equal_range(key);
    if (std::none_of(first, last, [&](const auto& one) { return one.second == digest; })) return false;
  }
  return true;
}

struct Counts {
  int damages = 0, opened = 0, refused = 0, recovered = 0, nothing = 0, wrong = 0;
  double saved = 0.0;  ///< mean share of the samples
};

class Study {
 public:
  Study(fs::path folder, std::uint64_t seed) : folder_(std::move(folder)), random_(seed) {
    const fs::path path = folder_ / "whole.capstan";
    SessionWriter writer(path, testing::header(), SessionWriter::Durability::kPlain);
    writer.begin();
    std::int64_t seq = 0;
    for (const tracking::Sample& sample : testing::someSamples(seed, 420, 48, 32))
      std::visit([&](const auto& row) { writer.write(++seq, row); }, sample);
    writer.commit();
    writer.finish();
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    bool refused = false;
    whole_ = samplesOf(path, refused);
    std::printf("session of %.2f MB, %zu samples\n", 1e-6 * static_cast<double>(bytes_.size()),
                whole_.size());
  }

  Counts truncationsAtEveryByte() {
    Counts counts;
    const fs::path path = folder_ / "short.capstan";
    write(path, bytes_);
    for (std::size_t size = bytes_.size() - 1; size > 0; --size) {
      fs::resize_file(path, size);
      open(path, counts);
    }
    return counts;
  }

  Counts truncations(int count) {
    return damaged(count, [&](std::string& bytes) { bytes.resize(at(bytes)); });
  }

  Counts flips(int count) {
    return damaged(
        count, [&](std::string& bytes) { bytes[at(bytes)] ^= static_cast<char>(1 << random_.bits() % 8); });
  }

 private:
  std::size_t at(const std::string& bytes) { return random_.bits() % bytes.size(); }

  static void write(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  }

  void open(const fs::path& path, Counts& counts) {
    bool refused = false;
    const Samples samples = samplesOf(path, refused);
    ++counts.damages;
    ++(refused ? counts.refused : counts.opened);
    if (!within(samples, whole_) || (!refused && samples.size() != whole_.size())) ++counts.wrong;
  }

  template <class Damage>
  Counts damaged(int count, Damage&& damage) {
    Counts counts;
    const fs::path path = folder_ / "damaged.capstan", saved = folder_ / "saved.capstan";
    for (int i = 0; i < count; ++i) {
      std::string bytes = bytes_;
      damage(bytes);
      write(path, bytes);
      open(path, counts);
      recover(path, saved, counts);
    }
    if (counts.recovered > 0) counts.saved /= counts.recovered;
    return counts;
  }

  void recover(const fs::path& path, const fs::path& saved, Counts& counts) {
    const Recovery recovery = recoverSession(path, saved, {base::writeYaml(testing::raven())});
    if (recovery.saved() == 0) {
      ++counts.nothing;
      return;
    }
    bool refused = false;
    const Samples samples = samplesOf(saved, refused);
    ++counts.recovered;
    counts.saved += static_cast<double>(samples.size()) / static_cast<double>(whole_.size());
    if (refused || !within(samples, whole_) || (recovery.whole() && samples.size() != whole_.size()))
      ++counts.wrong;
  }

  const fs::path folder_;
  base::Random random_;
  std::string bytes_;
  Samples whole_;
};

void print(const char* what, const Counts& counts) {
  std::printf(
      "%-26s %8d damaged: %8d opened whole, %8d refused; %6d recovered (%.1f %% of the samples), %d with "
      "nothing to save; %d WRONG\n",
      what, counts.damages, counts.opened, counts.refused, counts.recovered, 100.0 * counts.saved,
      counts.nothing, counts.wrong);
}

}  // namespace

int main(int argc, char** argv) {
  int truncations = 1000, flips = 1000;
  std::uint64_t seed = 1;
  bool every = false;
  CLI::App app("What comes of damaged session files");
  app.add_option("--truncations", truncations, "files cut at a random byte, opened and recovered");
  app.add_option("--flips", flips, "files with one changed bit, opened and recovered");
  app.add_flag("--every-byte", every, "also cut at every byte, opened only");
  app.add_option("--seed", seed);
  CLI11_PARSE(app, argc, argv);
  const testing::TemporaryFolder folder;
  Study study(folder.path(), seed);
  const Counts cut = study.truncations(truncations), flipped = study.flips(flips);
  print("cut at a random byte", cut);
  print("one bit changed", flipped);
  int wrong = cut.wrong + flipped.wrong;
  if (every) {
    const Counts all = study.truncationsAtEveryByte();
    print("cut at every byte", all);
    wrong += all.wrong;
  }
  return wrong > 0;
}
