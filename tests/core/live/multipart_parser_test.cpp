#include "core/live/cameras/multipart_parser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace capstan::live {
namespace {

using TimePoint = MultipartParser::TimePoint;
constexpr std::chrono::milliseconds kTick{1};

/// Parts of a body that comes in pieces of `size` bytes, one a millisecond.
std::vector<JpegPart> partsOf(const std::string& body, std::size_t size, MultipartParser& parser) {
  std::vector<JpegPart> parts;
  TimePoint now;
  for (std::size_t k = 0; k < body.size(); k += size, now += kTick)
    parser.add(std::string_view(body).substr(k, size), now,
               [&](JpegPart&& part) { parts.push_back(std::move(part)); });
  return parts;
}
std::vector<JpegPart> partsOf(const std::string& body, std::size_t size = 7) {
  MultipartParser parser;
  return partsOf(body, size, parser);
}
std::string textOf(const JpegPart& part) { return {part.bytes.begin(), part.bytes.end()}; }

std::string faultOf(const std::string& body) {
  try {
    partsOf(body, 1000);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MultipartParser, TakesImagesOutOfAnyPieces) {
  const std::string body =
      "--image\r\nContent-Type: image/jpeg\r\nContent-Length: 9\r\nX-Timestamp: 1700000000.000250\r\n\r\n"
      "--image\r\n\r\n--image\r\ncontent-type: IMAGE/JPEG\r\n\r\nwithout\nlength\r\n"
      "--image\r\nContent-Length: 3\r\nX-Timestamp: 12\r\n\r\nabc\r\n--image--\r\nthe end";
  for (const std::size_t size : {1, 2, 3, 7, 1000}) {
    MultipartParser parser;
    const auto parts = partsOf(body, size, parser);
    ASSERT_EQ(parts.size(), 3U) << size;
    EXPECT_EQ(textOf(parts[0]), "--image\r\n") << "its length counts, not what looks like a boundary";
    EXPECT_EQ(textOf(parts[1]), "without\nlength");
    EXPECT_EQ(textOf(parts[2]), "abc");
    EXPECT_EQ(parts[0].stamp, 1700000000000250000);
    EXPECT_EQ(parts[1].stamp, 0);
    EXPECT_EQ(parts[2].stamp, 12000000000);
    EXPECT_TRUE(parser.ended());
  }
}

/// mjpg-streamer begins with an empty line and a blank after the boundary; others give the boundary hyphens.
TEST(MultipartParser, TakesWhatServersSend) {
  for (const std::string boundary : {"--boundarydonotcross ", "----x", "--"}) {
    const std::string part = "Content-Type: image/jpeg\r\nContent-Length: 4\r\n\r\njpeg\r\n";
    const auto parts = partsOf("\r\n" + boundary + "\r\n" + part + boundary + "\r\n" + part);
    EXPECT_EQ(parts.size(), boundary == "--" ? 0U : 2U) << boundary;
  }
  EXPECT_EQ(partsOf("--b\nContent-Type: image/jpg\n\nunix\n--b\n").size(), 1U);
}

TEST(MultipartParser, GoesOnAfterAWrongLength) {
  const auto parts = partsOf(
      "--b\r\nContent-Length: 4\r\n\r\njpeg and\n--more of it\r\n--b\r\nContent-Length: 3\r\n\r\nabc\r\n");
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(textOf(parts[1]), "abc");
}

/// The boundary may come with the next image only.
TEST(MultipartParser, AnImageArrivesWithItsLastByte) {
  for (const std::string length : {"", "Content-Length: 4\r\n"}) {
    MultipartParser parser;
    TimePoint arrival;
    const auto each = [&](JpegPart&& part) { arrival = part.arrival; };
    parser.add("--b\r\n" + length + "\r\nje", TimePoint(1 * kTick), each);
    parser.add("pg\r\n", TimePoint(2 * kTick), each);
    parser.add("--b\r\n" + length + "\r\nnext", TimePoint(40 * kTick), each);
    EXPECT_EQ(arrival, TimePoint((length.empty() ? 2 : 40) * kTick)) << length;
  }
}

TEST(MultipartParser, RefusesWhatIsNoMotionJpeg) {
  const std::string many(MultipartParser::kMostHead + 1, 'x');
  EXPECT_NE(faultOf(many).find("without an image"), std::string::npos);
  EXPECT_NE(faultOf("<html>\n" + many).find("without an image"), std::string::npos);
  EXPECT_NE(faultOf("--b\r\nX: " + many).find("without an image"), std::string::npos);
  EXPECT_NE(faultOf("--b\r\nContent-Type: text/html\r\n\r\n").find("text/html"), std::string::npos);
  for (const std::string wrong : {"-1", "four", "99999999999999999999", "67108865", "12a", ""})
    EXPECT_NE(faultOf("--b\r\nContent-Length: " + wrong + "\r\n\r\n").find("Content-Length"),
              std::string::npos)
        << wrong;
}

TEST(MultipartParser, RefusesAnImageWithoutEnd) {
  MultipartParser parser;
  const std::string piece(1 << 20, 'x');
  parser.add("--b\r\n\r\n", {}, {});
  EXPECT_THROW(for (std::size_t k = 0; k <= MultipartParser::kMostImage >> 20; ++k) parser.add(piece, {}, {}),
               base::InputError);
}

TEST(MultipartParser, ReadsTimestamps) {
  EXPECT_EQ(parseTimestamp("1700000000.123456"), 1700000000123456000);
  EXPECT_EQ(parseTimestamp("1700000000.1234567891"), 1700000000123456789);
  EXPECT_EQ(parseTimestamp("0.5"), 500000000);
  EXPECT_EQ(parseTimestamp("7"), 7000000000);
  EXPECT_EQ(parseTimestamp("7."), 7000000000);
  for (const char* wrong : {"", ".", ".5", "-1.0", "1,5", "1.5s", "nan", "1e9", "1.-5", "99999999999.0"})
    EXPECT_EQ(parseTimestamp(wrong), 0) << wrong;
}

}  // namespace
}  // namespace capstan::live
