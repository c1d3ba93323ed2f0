// Frame encoding of the recorder against PNG level 1, same images, one run: processor time a frame and the
// share of one core at 2 × 15 frames/s.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/recording/frame_codec.h"

namespace {

constexpr double kFramesPerSecond = 2 * 15.0;

/// A lit, textured background with a marker and sensor noise of 3 grey levels, 640×480.
const std::vector<cv::Mat>& pictures() {
  static const std::vector<cv::Mat> made = [] {
    std::vector<cv::Mat> images;
    cv::RNG random(1);
    for (int k = 0; k < 8; ++k) {
      cv::Mat light(480, 640, CV_16SC3), noise(480, 640, CV_16SC3), image;
      for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x) {
          const double l =
              90 + 40 * std::sin(x * .01 + y * .007) + 20 * std::sin(x * .11) * std::cos(y * .13);
          light.at<cv::Vec3s>(y, x) = {static_cast<short>(l * .7), static_cast<short>(l * .8),
                                       static_cast<short>(l)};
        }
      random.fill(noise, cv::RNG::NORMAL, 0, 3);
      cv::Mat(light + noise).convertTo(image, CV_8U);
      cv::circle(image, {200 + 5 * k, 240}, 14, {60, 200, 40}, cv::FILLED, cv::LINE_AA);
      images.push_back(image);
    }
    return images;
  }();
  return made;
}

template <class Encode>
void run(benchmark::State& state, Encode&& encode) {
  std::size_t bytes = 0, frame = 0;
  for (auto _ : state) bytes += encode(pictures()[frame++ % pictures().size()]);
  const auto frames = static_cast<double>(frame);
  state.counters["size_%"] = 100.0 * static_cast<double>(bytes) / frames / (640.0 * 480.0 * 3.0);
  state.counters["core_%_at_30/s"] = benchmark::Counter(
      frames / kFramesPerSecond / 100.0, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void recorderCodec(benchmark::State& state) {
  capstan::recording::FrameEncoder encoder(640, 480);
  run(state, [&](const cv::Mat& image) { return encoder.encode(image).size(); });
}
void pngLevel1(benchmark::State& state) {
  std::vector<std::uint8_t> packet;
  run(state, [&](const cv::Mat& image) {
    cv::imencode(".png", image, packet, {cv::IMWRITE_PNG_COMPRESSION, 1});
    return packet.size();
  });
}
void decode(benchmark::State& state) {
  capstan::recording::FrameEncoder encoder(640, 480);
  const auto packet = encoder.encode(pictures()[0]);
  capstan::recording::FrameDecoder decoder(encoder.parameters(), "benchmark");
  cv::Mat image;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(decoder.decode(packet, image));
}

BENCHMARK(recorderCodec)->Unit(benchmark::kMillisecond);
BENCHMARK(pngLevel1)->Unit(benchmark::kMillisecond);
BENCHMARK(decode)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
