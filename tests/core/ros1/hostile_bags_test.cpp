// Bags of strangers: lengths and sizes that no message has.
#include <gmock/gmock.h>

#include <cstring>

#include "core/base/error.h"
#include "core/ros1/bag_record.h"
#include "core/ros1/compressed_size.h"
#include "core/ros1/image_message.h"
#include "core/ros1/raven_state.h"
#include "core/ros1/session_text.h"
#include "tests/support/error_of.h"
#include "tests/support/folders.h"

namespace capstan::ros1 {
namespace {

using test::errorOf;
using ::testing::HasSubstr;

std::string definitionWith(const std::string& from, const std::string& to) {
  std::string text = RavenStateLayout::kDefinition;
  return text.replace(text.find(from), from.size(), to);
}

TEST(HostileBag, LengthsOfARavenStateAreLengths) {  // a negative one let values be read before the message
  for (const char* length : {"int32[-40] pos", "int64[2305843009213693951] pos",
                             "int32[99999999999999999999] pos", "int32[6 pos", "int32[x] pos"})
    EXPECT_THAT(errorOf<std::exception>([&] { RavenStateLayout(definitionWith("int32[6] pos", length)); }),
                HasSubstr("has a variable length"))
        << length;
  const RavenStateLayout layout(RavenStateLayout::kDefinition);
  EXPECT_THAT(errorOf<std::exception>([&] { layout.read(Bytes(100, 0xff)); }), HasSubstr("ends too early"));
}

/// A PNG image of this size, without its data.
Bytes pngOf(std::uint32_t width, std::uint32_t height) {
  Bytes bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  for (const std::uint32_t side : {width, height})
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(side >> shift));
  return bytes;
}

TEST(HostileBag, CompressedImagesStateTheirSize) {
  EXPECT_EQ(compressedSizeOf(pngOf(640, 480))->width, 640U);
  const Bytes jpeg = {0xff, 0xd8, 0xff, 0xe0, 0,    4,    1,    2,    0xff, 0xff,
                      0xc0, 0,    11,   8,    0x01, 0xe0, 0x02, 0x80, 1,    1};
  ASSERT_TRUE(compressedSizeOf(jpeg));
  EXPECT_EQ(compressedSizeOf(jpeg)->width, 640U);
  EXPECT_EQ(compressedSizeOf(jpeg)->height, 480U);
  for (std::size_t size = 0; size < jpeg.size(); ++size) compressedSizeOf(std::span(jpeg).first(size));
  EXPECT_FALSE(compressedSizeOf(Bytes{'B', 'M', 1, 2, 3}));
}

TEST(HostileBag, ImagesOfABillionPixelsAreNotDecoded) {
  CompressedImage image;
  image.data = pngOf(30000, 30000);
  EXPECT_THAT(errorOf<std::exception>([&] { imageOf(image); }),
              HasSubstr("data = 30000 x 30000 pixels: are too many for an image"));
  image.data = {'I', 'I', '*', 0};  // TIFF: OpenCV has many more readers
  EXPECT_THAT(errorOf<std::exception>([&] { imageOf(image); }), HasSubstr("are no image"));
  Image raw;
  raw.encoding = "mono8";
  raw.width = raw.height = raw.step = 65536;
  EXPECT_THAT(errorOf<std::exception>([&] { imageOf(raw); }), HasSubstr("do not hold 65536 x 65536 pixels"));
}

TEST(HostileBag, AChunkStatesNoSizeThatItCannotHave) {
  EXPECT_THAT(errorOf<std::exception>([] { uncompressed(Bytes(100, 0), "lz4", 1U << 28U); }),
              HasSubstr("states a wrong size"));
  EXPECT_THAT(errorOf<std::exception>([] { uncompressed(Bytes(100, 0), "bz2", 1000); }),
              HasSubstr("cannot be uncompressed"));
}

TEST(HostileBag, ASessionsTextHasPossibleNumbers) {
  const std::string text = "title: a\nrobot: b\nbegin: 0\nduration: 1\nepoch: ";
  EXPECT_THAT(errorOf<std::exception>([&] { parseSessionText(text + "4294967295\n", "trial.bag"); }),
              HasSubstr("outside the allowed range"));
  SessionText scaled;
  scaled.base_from_camera = 2.0 * Eigen::Matrix4d::Identity();
  scaled.robot =
      robot::formatDescription(robot::readDescription(test::resourceFile("robots/raven2_left.yaml")));
  tracking::SourceInfo info;
  EXPECT_THAT(errorOf<std::exception>([&] { takeSessionText(scaled, "trial.bag", info); }),
              HasSubstr("base_from_camera: is no rigid transform"));
}

}  // namespace
}  // namespace capstan::ros1
