#pragma once

#include <unistd.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <string>

#include "core/base/random.h"
#include "core/base/yaml.h"
#include "core/recording/session_file.h"
#include "core/robot/description.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"
#include "core/vision/marker.h"
#include "tests/support/folders.h"
#include "tests/support/temporary_folder.h"

/// Made-up samples and files for the session tests.
namespace capstan::recording::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using test::TemporaryFolder;

inline robot::Description raven() {
  return robot::readDescription(test::resourceFile("robots/raven2_left.yaml"));
}

/// The data sets: CAPSTAN_DATA, else ../shared/data beside the repository; empty where absent.
inline std::filesystem::path dataFile(const std::string& name) {
  const std::filesystem::path file = test::dataFolder() / name;
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

inline SessionHeader header() {
  SessionHeader header;
  header.title = "a test";
  header.created = "2026-11-21T01:00:00Z";
  header.software = "capstan test";
  header.robot = base::writeYaml(raven());
  header.marker = base::writeYaml(vision::MarkerOptions{});
  header.tracking = "memory: 0.2\n";
  header.truth = "truth: yes\n";
  header.reference = true;
  return header;
}

/// Bits that a lossless store may lose: negative zero, the smallest denormal, neighbours of one, extremes,
/// and none.
inline double awkward(base::Random& random) {
  switch (random.bits() % 9) {
    case 0:
      return -0.0;
    case 1:
      return std::numeric_limits<double>::denorm_min();
    case 2:
      return 1.0 + std::numeric_limits<double>::epsilon();
    case 3:
      return -std::numeric_limits<double>::max();
    case 4:
      return kNaN;
    case 5:
      return 42.0;
    case 6:
      return 9007199254740993.0;
    default:
      return random.normal(0.0, 100.0);
  }
}

inline Eigen::Vector3d awkwardVector(base::Random& random) {
  return {awkward(random), awkward(random), awkward(random)};
}

inline cv::Mat noisyImage(base::Random& random, int width = 64, int height = 48) {
  cv::Mat image(height, width, CV_8UC3);
  for (int row = 0; row < height; ++row)
    for (int i = 0; i < 3 * width; ++i) image.ptr(row)[i] = static_cast<std::uint8_t>(random.bits() >> 56);
  return image;
}

/// The same bits, except that one NaN is like another.
inline bool sameBits(double a, double b) {
  return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool sameBits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return sameBits(a(0), b(0)) && sameBits(a(1), b(1)) && sameBits(a(2), b(2));
}
inline bool sameBits(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.size == b.size && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

inline bool sameBits(const tracking::Sample& a, const tracking::Sample& b) {
  using namespace tracking;
  if (a.index() != b.index()) return false;
  if (const auto* x = std::get_if<MotorSample>(&a)) {
    const auto& y = std::get<MotorSample>(b);
    return sameBits(x->t, y.t) && sameBits(x->position, y.position) && sameBits(x->velocity, y.velocity) &&
           sameBits(x->torque, y.torque);
  }
  if (const auto* x = std::get_if<JointSample>(&a))
    return sameBits(x->t, std::get<JointSample>(b).t) &&
           sameBits(x->position, std::get<JointSample>(b).position);
  if (const auto* x = std::get_if<TipSample>(&a)) {
    const auto& y = std::get<TipSample>(b);
    return sameBits(x->t, y.t) && sameBits(x->t_arrival, y.t_arrival) && sameBits(x->position, y.position);
  }
  const auto& x = std::get<StereoFrame>(a);
  const auto& y = std::get<StereoFrame>(b);
  return sameBits(x.t, y.t) && sameBits(x.t_arrival, y.t_arrival) && sameBits(x.left, y.left) &&
         sameBits(x.right, y.right);
}

/// `count` samples of all four kinds in random turn, values awkward, times increasing with repetitions.
inline std::vector<tracking::Sample> someSamples(std::uint64_t seed, int count, int width = 64,
                                                 int height = 48) {
  base::Random random(seed);
  std::vector<tracking::Sample> samples;
  double t = 0.0;
  for (int i = 0; i < count; ++i) {
    t += random.uniform(0.0, 1.0) < 0.3 ? 0.0 : 1e-3;
    switch (random.bits() % 4) {
      case 0:
        samples.push_back(
            tracking::MotorSample{t, awkwardVector(random), awkwardVector(random), awkwardVector(random)});
        break;
      case 1:
        samples.push_back(tracking::JointSample{t, awkwardVector(random)});
        break;
      case 2:
        samples.push_back(tracking::TipSample{t - 0.04, t, awkwardVector(random)});
        break;
      default: {
        tracking::StereoFrame frame{t - 0.03, t, noisyImage(random, width, height),
                                    noisyImage(random, width, height)};
        if (random.bits() % 8 == 0) frame.left = cv::Mat();
        if (random.bits() % 8 == 0) frame.right = cv::Mat();
        samples.push_back(frame);
      }
    }
  }
  return samples;
}

inline tracking::Snapshot someSnapshot(base::Random& random) {
  tracking::Snapshot snapshot;
  snapshot.t = random.uniform(0.0, 10.0);
  snapshot.t_cam = awkward(random);
  for (auto* vector :
       {&snapshot.q_link_kin, &snapshot.q_link_cam, &snapshot.q_link_cam_sigma, &snapshot.q_link_ukf,
        &snapshot.dq_link_ukf, &snapshot.q_link_ukf_sigma, &snapshot.q_link_true})
    *vector = awkwardVector(random);
  snapshot.gate = tracking::Gate::kJump;
  snapshot.camera_updated = random.bits() % 2 == 0;
  snapshot.nis = awkward(random);
  snapshot.nees = awkward(random);
  return snapshot;
}

}  // namespace capstan::recording::testing
