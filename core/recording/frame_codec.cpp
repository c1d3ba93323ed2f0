#include "core/recording/frame_codec.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/opt.h>
}

#include <algorithm>
#include <cstring>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "core/base/check.h"
#include "core/base/error.h"

namespace capstan::recording {
namespace {

// Measured on noisy 640×480 colour images: 2.1 ms per frame, 57 % of its size. Median prediction takes longer
// to decode and saves nothing; HuffYUV takes slightly less time and more space; PNG level 1 takes ten times
// as long.
constexpr const char* kCodecName = "utvideo";
constexpr const char* kPrediction = "left";

struct FreeContext {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
};
struct FreeFrame {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
};
struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
using Context = std::unique_ptr<AVCodecContext, FreeContext>;
using Frame = std::unique_ptr<AVFrame, FreeFrame>;
using Packet = std::unique_ptr<AVPacket, FreePacket>;

/// Number of image columns given to libavcodec: a multiple of four. For other widths its encoder reserves no
/// room for the padding of planes and truncates the packet of an incompressible image.
int codedWidth(int width) { return (width + 3) / 4 * 4; }

Context makeContext(const AVCodec* codec, int width, int height) {
  Context context(avcodec_alloc_context3(codec));
  if (!context) throw std::bad_alloc();
  context->width = codedWidth(width);
  context->height = height;
  context->pix_fmt = AV_PIX_FMT_GBRP;
  context->time_base = {1, 15};
  context->thread_count = 1;
  return context;
}

/// libavcodec's planes in the channel order of OpenCV (B, G, R); the first `width` columns.
std::array<cv::Mat, 3> planesOf(AVFrame& frame, int width) {
  const auto plane = [&](int index) {
    return cv::Mat(frame.height, width, CV_8UC1, frame.data[index],
                   static_cast<std::size_t>(frame.linesize[index]));
  };
  return {plane(1), plane(0), plane(2)};
}

}  // namespace

class FrameEncoder::Impl {
 public:
  Impl(int width, int height) : frame_(av_frame_alloc()), packet_(av_packet_alloc()) {
    if (!isFrameSize(width, height))
      throw std::runtime_error("images of " + std::to_string(width) + "x" + std::to_string(height) +
                               " pixels cannot be stored");
    const AVCodec* codec = avcodec_find_encoder_by_name(kCodecName);
    if (!codec) throw std::runtime_error("libavcodec has no encoder " + std::string(kCodecName));
    context_ = makeContext(codec, width, height);
    av_opt_set(context_->priv_data, "pred", kPrediction, 0);
    if (avcodec_open2(context_.get(), codec, nullptr) < 0)
      throw std::runtime_error("libavcodec refuses to encode images of " + std::to_string(width) + "x" +
                               std::to_string(height));
    frame_->width = codedWidth(width);
    frame_->height = height;
    frame_->format = AV_PIX_FMT_GBRP;
    if (av_frame_get_buffer(frame_.get(), 0) < 0) throw std::bad_alloc();
    parameters_ = {kCodecName,
                   width,
                   height,
                   {context_->extradata, context_->extradata + context_->extradata_size},
                   context_->codec_tag};
  }

  const CodecParameters& parameters() const { return parameters_; }

  std::span<const std::uint8_t> encode(const cv::Mat& bgr) {
    CAPSTAN_CHECK(bgr.type() == CV_8UC3 && bgr.cols == parameters_.width && bgr.rows == parameters_.height);
    if (av_frame_make_writable(frame_.get()) < 0) throw std::bad_alloc();
    auto planes = planesOf(*frame_, bgr.cols);
    cv::split(bgr, planes.data());
    for (int column = bgr.cols; column < frame_->width; ++column)
      for (int plane = 0; plane < 3; ++plane)
        for (int row = 0; row < bgr.rows; ++row)
          frame_->data[plane][row * frame_->linesize[plane] + column] = 0;
    av_packet_unref(packet_.get());
    if (avcodec_send_frame(context_.get(), frame_.get()) < 0 ||
        avcodec_receive_packet(context_.get(), packet_.get()) < 0)
      throw std::runtime_error("libavcodec failed to encode an image");
    return {packet_->data, static_cast<std::size_t>(packet_->size)};
  }

 private:
  Context context_;
  Frame frame_;
  Packet packet_;
  CodecParameters parameters_;
};

FrameEncoder::FrameEncoder(int width, int height) : impl_(std::make_unique<Impl>(width, height)) {}
FrameEncoder::~FrameEncoder() = default;
FrameEncoder::FrameEncoder(FrameEncoder&&) noexcept = default;
FrameEncoder& FrameEncoder::operator=(FrameEncoder&&) noexcept = default;
const CodecParameters& FrameEncoder::parameters() const { return impl_->parameters(); }
std::span<const std::uint8_t> FrameEncoder::encode(const cv::Mat& bgr) { return impl_->encode(bgr); }

class FrameDecoder::Impl {
 public:
  Impl(const CodecParameters& parameters, const std::string& file)
      : width_(parameters.width),
        height_(parameters.height),
        frame_(av_frame_alloc()),
        packet_(av_packet_alloc()) {
    // libavcodec has hundreds of decoders; a file of a stranger cannot choose one.
    const AVCodec* codec =
        parameters.name == kCodecName ? avcodec_find_decoder_by_name(parameters.name.c_str()) : nullptr;
    const auto refuse = [&](const char* reason) {
      throw base::InputError(
          {file, 0, "codec", parameters.name, reason, "Install a libavcodec that has this decoder"});
    };
    if (!codec) refuse("is not a codec of sessions, or not one of this libavcodec");
    if (!isFrameSize(parameters.width, parameters.height)) refuse("has an impossible size of images");
    context_ = makeContext(codec, parameters.width, parameters.height);
    const std::size_t size = parameters.extradata.size();
    context_->extradata = static_cast<std::uint8_t*>(av_mallocz(size + AV_INPUT_BUFFER_PADDING_SIZE));
    if (!context_->extradata) throw std::bad_alloc();
    std::copy(parameters.extradata.begin(), parameters.extradata.end(), context_->extradata);
    context_->extradata_size = static_cast<int>(size);
    context_->codec_tag = parameters.fourcc;
    if (avcodec_open2(context_.get(), codec, nullptr) < 0) refuse("is refused by libavcodec");
  }

  bool decode(std::span<const std::uint8_t> bytes, cv::Mat& bgr) {
    packet_->data = const_cast<std::uint8_t*>(bytes.data());  // libavcodec copies what it does not own
    packet_->size = static_cast<int>(bytes.size());
    const bool sent = avcodec_send_packet(context_.get(), packet_.get()) >= 0;
    packet_->data = nullptr;
    packet_->size = 0;
    if (!sent || avcodec_receive_frame(context_.get(), frame_.get()) < 0) return false;
    if (frame_->format != AV_PIX_FMT_GBRP || frame_->width < width_ || frame_->height != height_)
      return false;
    cv::merge(planesOf(*frame_, width_).data(), 3, bgr);
    return true;
  }

 private:
  int width_, height_;
  Context context_;
  Frame frame_;
  Packet packet_;
};

FrameDecoder::FrameDecoder(const CodecParameters& parameters, const std::string& file)
    : impl_(std::make_unique<Impl>(parameters, file)) {}
FrameDecoder::~FrameDecoder() = default;
FrameDecoder::FrameDecoder(FrameDecoder&&) noexcept = default;
FrameDecoder& FrameDecoder::operator=(FrameDecoder&&) noexcept = default;
bool FrameDecoder::decode(std::span<const std::uint8_t> packet, cv::Mat& bgr) {
  return impl_->decode(packet, bgr);
}

}  // namespace capstan::recording
