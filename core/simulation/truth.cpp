#include "core/simulation/truth.h"

#include <numbers>

#include "core/base/yaml.h"

namespace capstan::simulation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// Detector noise of each image coordinate [px], from rendered images of the default robot in block transfer.
/// The mean error of detected markers is 0.030 px (Rayleigh: sigma √(π / 2)), the 95th percentile 0.058 px
/// (sigma 2.45). `capstan-cli track --simulate --json -` measures it as "centroid".
constexpr double kDetectorSigma = 0.025;

EncoderTruth realEncoders() {
  EncoderTruth encoders;
  encoders.motor_quantised = true;
  encoders.joint_resolution = {kTurn / 80000.0, kTurn / 80000.0, 5e-6};
  return encoders;
}

ImageTruth realImages() {
  ImageTruth images;
  images.noise = 3.5;
  images.exposure_noise = 0.01;
  images.unevenness = 0.3;
  images.texture = 0.5;
  return images;
}

}  // namespace

Truth defaultTruth() {
  Truth truth;
  truth.name = "default";
  truth.joints[0] = {0.059, 0.85, 0.80, {100e3, 3e-5, 1.0, 0.5}, {0.3, 0.02}, 1.0};
  truth.joints[1] = {std::nullopt, 0.70, 0.75, {40e3, 1e-4, 1.0, 0.5}, {0.3, 0.02}, 1.0};
  truth.joints[2] = {std::nullopt, 0.75, 0.80, {4e3, 3e-4, 1.0, 0.5}, {0.4, 0.005}, 1.0};
  truth.encoders = realEncoders();
  truth.cameras = {15.0, 0.008, 0.040, 0.004, 0.0008, 0.0, {0.007, -0.005, 0.008}, kDetectorSigma};
  truth.images = realImages();
  return truth;
}

Truth matchedTruth() {
  Truth truth;
  truth.encoders = realEncoders();
  truth.cameras.exposure = 0.008;
  truth.cameras.pixel_sigma = kDetectorSigma;
  truth.images = realImages();
  return truth;
}

Truth readTruth(const std::filesystem::path& path) { return base::readYamlFile<Truth>(path); }

Truth parseTruth(const std::string& text, const std::string& name) {
  return base::readYaml<Truth>(text, name);
}

std::string formatTruth(const Truth& truth) { return base::writeYaml(truth); }

}  // namespace capstan::simulation
