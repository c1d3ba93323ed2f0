#include "core/ros1/image_message.h"

#include "core/base/error.h"
#include "core/ros1/message_codec.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

/// Reads a message as the reader of bags does, which names file and time.
template <class Message>
void readImage(const capstan::ros1::Bytes& bytes) {
  using namespace capstan;
  try {
    const cv::Mat image = ros1::imageOf(ros1::decode<Message>(bytes));
    fuzz::require(image.type() == CV_8UC3 && !image.empty(), "an image is 8-bit BGR");
  } catch (const base::InputError&) {
  } catch (const std::runtime_error&) {  // of decode()
  }
}

}  // namespace

CAPSTAN_FUZZ_TARGET(image_message) {
  using namespace capstan;
  const ros1::Bytes message(bytes.begin(), bytes.end());
  readImage<ros1::Image>(message);
  readImage<ros1::CompressedImage>(message);
}
