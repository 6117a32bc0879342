// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/internal/pgm.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

using namespace std::string_literals;

std::string pgm_refusal(const std::string& bytes) {
  return error_of([&bytes] { read_pgm(bytes, "map.pgm"); });
}

TEST(Pgm, BinaryOfEightBits) {
  const GreyImage image = read_pgm("P5\n3 2\n255\n\x00\x01\x02\xfd\xfe\xff"s, "map.pgm");
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.white, 255);
  EXPECT_EQ(image.greys, (std::vector<std::uint16_t>{0, 1, 2, 253, 254, 255}));
}

TEST(Pgm, BinaryOfSixteenBitsHasItsGreatByteFirst) {
  const GreyImage image = read_pgm("P5 2 1 65535\n\x01\x02\xff\xff"s, "map.pgm");
  EXPECT_EQ(image.white, 65'535);
  EXPECT_EQ(image.greys, (std::vector<std::uint16_t>{258, 65'535}));
}

TEST(Pgm, Plain) {
  const GreyImage image = read_pgm("P2\n# a comment\n2 2 9\n0 1\n 8\t9", "map.pgm");
  EXPECT_EQ(image.white, 9);
  EXPECT_EQ(image.greys, (std::vector<std::uint16_t>{0, 1, 8, 9}));
}

TEST(Pgm, CommentsStandBetweenTheNumbers) {
  const GreyImage image =
      read_pgm("P5#one\n# CREATOR: 0.05 m/pix\n2#two\r\n# 99\n 1\n#three\n255\n#!"s, "map.pgm");
  EXPECT_EQ(image.width, 2);
  // After the maximum grey, everything is a grey value, even a #.
  EXPECT_EQ(image.greys, (std::vector<std::uint16_t>{'#', '!'}));
  EXPECT_EQ(read_pgm("P2 1 1 255 7 # the end", "map.pgm").greys.size(), 1U);
}

TEST(Pgm, ANewlineAfterTheLastGreyIsLetPass) {
  EXPECT_EQ(read_pgm("P5 1 1 255\nA\n", "map.pgm").greys, std::vector<std::uint16_t>{'A'});
  EXPECT_EQ(pgm_refusal("P5 1 1 255\nAB"),
            "map.pgm: byte 13: 1 × 1 cells need 1 bytes, and 0 are there");
  EXPECT_TRUE(contains(pgm_refusal("P5 1 1 255\nA\n\n"), "need 1 bytes, and 3 are there"));
}

TEST(Pgm, RefusesWhatIsNoImage) {
  EXPECT_EQ(pgm_refusal(""), "map.pgm: byte 0: the file is empty");
  const std::string no_pgm =
      "map.pgm: byte 0: is not a grey PGM image (it would begin with P5 or P2)";
  for (const char* bytes : {"P", "P6\n1 1 255\nABC", "\x89PNG\r\n", "#P5", " P5 1 1 255\nA"}) {
    EXPECT_EQ(pgm_refusal(bytes), no_pgm) << bytes;
  }
}

TEST(Pgm, RefusesBadHeaders) {
  EXPECT_EQ(pgm_refusal("P5"), "map.pgm: byte 2: ends where the width was expected");
  EXPECT_EQ(pgm_refusal("P53 2 255\nABCDEF"), "map.pgm: byte 2: expected the width");
  EXPECT_EQ(pgm_refusal("P5 a 2 255\n"), "map.pgm: byte 3: expected the width");
  EXPECT_EQ(pgm_refusal("P5 -3 2 255\n"), "map.pgm: byte 3: expected the width");
  EXPECT_EQ(pgm_refusal("P5 3 # 2"), "map.pgm: byte 8: ends where the height was expected");
  EXPECT_EQ(pgm_refusal("P5 3 0 255\n"), "map.pgm: byte 5: the height is not 1 to 1000000");
  EXPECT_EQ(pgm_refusal("P5 3 2 0\nABCDEF"),
            "map.pgm: byte 7: the maximum grey value is not 1 to 65535");
  EXPECT_EQ(pgm_refusal("P5 3 2 65536\nABCDEF"),
            "map.pgm: byte 7: the maximum grey value is not 1 to 65535");
  EXPECT_EQ(pgm_refusal("P5 3 2 255"), "map.pgm: byte 10: expected a space before the greys");
  EXPECT_EQ(pgm_refusal("P5 3 2 255x"), "map.pgm: byte 10: expected a space before the greys");
}

TEST(Pgm, NeverTrustsASize) {
  // None of these allocates memory for the size that the header claims, or overflows.
  EXPECT_TRUE(contains(pgm_refusal("P5 1000000 1000000 255\nA"),
                       "1000000 × 1000000 cells need 1000000000000 bytes, and 1 are there"));
  EXPECT_TRUE(contains(pgm_refusal("P2 1000000 1000000 255\n1"), "need 2000000000000 bytes"));
  EXPECT_TRUE(contains(pgm_refusal("P5 1000001 1 255\nA"), "the width is not"));
  EXPECT_TRUE(contains(pgm_refusal("P5 4294967297 1 255\nA"), "the width is not"));
  EXPECT_TRUE(contains(pgm_refusal("P5 99999999999999999999999999 1 255\nA"), "the width is not"));
  EXPECT_TRUE(contains(pgm_refusal("P5 2 2 65535\nABCD"), "need 8 bytes, and 4 are there"));
}

TEST(Pgm, RefusesGreysThatCannotBe) {
  EXPECT_EQ(pgm_refusal("P5 2 1 9\n\x05\x0b"), "map.pgm: byte 11: grey 11 is above 9");
  EXPECT_EQ(pgm_refusal("P2 2 1 9\n5 11"), "map.pgm: byte 11: a grey is not 0 to 9");
  EXPECT_EQ(pgm_refusal("P2 2 1 9\n5 x"), "map.pgm: byte 11: expected a grey");
  EXPECT_EQ(pgm_refusal("P2 2 1 9\n5    "), "map.pgm: byte 14: ends where a grey was expected");
  EXPECT_EQ(pgm_refusal("P2 2 1 9\n5 6 7"),
            "map.pgm: byte 13: more grey values than the size states");
}

RC_GTEST_PROP(Pgm, BothKindsSayTheSame, ()) {
  const int white = *rc::gen::inRange(1, 65536);
  const int width = *rc::gen::inRange(1, 12);
  const int height = *rc::gen::inRange(1, 12);
  std::string header =
      std::to_string(width) + " " + std::to_string(height) + "\n" + std::to_string(white) + "\n";
  std::string plain = "P2\n" + header;
  std::string binary = "P5\n" + header;
  std::vector<std::uint16_t> greys;
  for (int i = 0; i < width * height; ++i) {
    const int grey = *rc::gen::inRange(0, white + 1);
    greys.push_back(static_cast<std::uint16_t>(grey));
    plain += std::to_string(grey) + (i % 7 == 6 ? "\n" : " ");
    if (white > 255) binary.push_back(static_cast<char>(grey / 256));
    binary.push_back(static_cast<char>(grey % 256));
  }
  RC_ASSERT(read_pgm(plain, "plain").greys == greys);
  RC_ASSERT(read_pgm(binary, "binary").greys == greys);
}

RC_GTEST_PROP(Pgm, TornOrSpoiltImagesAreRefusedOrRead, ()) {
  std::string bytes = *rc::gen::element("P5\n# map\n4 3\n255\nabcdefghijkl"s,
                                        "P2 3 2 99\n1 2 3 4 5 98\n"s, "P5 2 1 999\n\1\2\3\4"s);
  const auto length = bytes.size();
  if (*rc::gen::arbitrary<bool>()) bytes.resize(*rc::gen::inRange<std::size_t>(0, length));
  for (int i = *rc::gen::inRange(0, 4); i > 0 && !bytes.empty(); --i) {
    bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<char>();
  }
  try {
    const GreyImage image = read_pgm(bytes, "map.pgm");
    RC_ASSERT(image.greys.size() == static_cast<std::size_t>(image.width * image.height));
    for (const std::uint16_t grey : image.greys) RC_ASSERT(grey <= image.white);
  } catch (const Error& error) {
    RC_ASSERT(std::string(error.what()).rfind("map.pgm: byte ", 0) == 0);
  }
}

}  // namespace
}  // namespace tagfield
