// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/cdr.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "adapters/ros2/ros2_messages.h"

namespace tagfield::ros2 {
namespace {

using namespace std::string_literals;

// By hand from the tables of OMG DDSI-RTPS 10: a number begins at a multiple of its size, counted
// from the end of the four-byte header.
TEST(Cdr, GoldenBytesOfARead) {
  const tagfield_msgs::TagRead read{{{1, 2}, "ant"}, "E2", "r", "a", 1.0, 0.5, -2.0, 0.0};
  const std::string expected = "\0\1\0\0"s +              // CDR, little endian
                               "\1\0\0\0\2\0\0\0"s +      // stamp
                               "\4\0\0\0ant\0"s +         // frame_id: 16 bytes so far
                               "\3\0\0\0E2\0\0"s +        // epc, and padding up to the next length
                               "\2\0\0\0r\0\0\0"s +       // reader
                               "\2\0\0\0a\0\0\0"s +       // antenna: 40 bytes so far
                               "\0\0\0\0\0\0\xf0\x3f"s +  // 1.0
                               "\0\0\0\0\0\0\xe0\x3f"s +  // 0.5
                               "\0\0\0\0\0\0\0\xc0"s +    // -2.0
                               "\0\0\0\0\0\0\0\0"s;       // 0.0
  EXPECT_EQ(to_cdr(read), expected);
}

TEST(Cdr, GoldenBytesOfLists) {
  tagfield_msgs::AntennaTruth truth{{{0, 0}, ""}, "", {}, {"x"}, {1.0}};
  truth.pose.orientation = {0, 0, 0, 0};
  const std::string expected = "\0\1\0\0\0\0\0\0\0\0\0\0\1\0\0\0\0\0\0\0"s +  // header: 16
                               "\1\0\0\0\0\0\0\0"s +                          // antenna: 24
                               std::string(56, '\0') +                        // pose: 80
                               "\1\0\0\0\2\0\0\0x\0\0\0"s +                   // epcs: 92
                               "\1\0\0\0\0\0\0\0\0\0\xf0\x3f"s;               // distances
  EXPECT_EQ(to_cdr(truth), expected);
}

TEST(Cdr, GoldenBytesOfAMap) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info = {{3, 4}, 0.5F, 3, 1, {}};
  map.data = {-1, 0, 100};
  const std::string expected = "\0\1\0\0\0\0\0\0\0\0\0\0\4\0\0\0map\0"s +  // header: 16
                               "\3\0\0\0\4\0\0\0"s +                       // map_load_time
                               "\0\0\0\x3f\3\0\0\0\1\0\0\0"s +  // resolution, width, height: 36
                               "\0\0\0\0"s +                    // padding up to the next double
                               std::string(54, '\0') + "\xf0\x3f"s +  // origin: no rotation
                               "\3\0\0\0\xff\0\x64"s;                 // cells
  EXPECT_EQ(to_cdr(map), expected);
}

tagfield_msgs::TagReads drawn_reads() {
  tagfield_msgs::TagReads reads;
  const auto text = [] { return *rc::gen::container<std::string>(rc::gen::inRange('a', 'z')); };
  reads.header = {{*rc::gen::arbitrary<std::int32_t>(), *rc::gen::arbitrary<std::uint32_t>()},
                  text()};
  reads.antenna = text();
  const int count = *rc::gen::inRange(0, 5);
  for (int i = 0; i < count; ++i) {
    reads.reads.push_back({reads.header, text(), text(), text(), *rc::gen::arbitrary<double>(),
                           *rc::gen::arbitrary<double>(), -60.0, 0.0});
  }
  return reads;
}

RC_GTEST_PROP(Cdr, ReadsWhatItWrote, ()) {
  const tagfield_msgs::TagReads reads = drawn_reads();
  tagfield_msgs::TagReads back;
  RC_ASSERT(from_cdr(to_cdr(reads), back));
  RC_ASSERT(to_cdr(back) == to_cdr(reads));
}

RC_GTEST_PROP(Cdr, WhatIsCutOffIsNotWhole, ()) {
  const std::string bytes = to_cdr(drawn_reads());
  const auto length = *rc::gen::inRange<std::size_t>(0, bytes.size());
  tagfield_msgs::TagReads back;
  RC_ASSERT(!from_cdr(std::string_view(bytes).substr(0, length), back));
}

RC_GTEST_PROP(Cdr, AnyBytesAreReadWithoutHarm, ()) {
  std::string bytes = to_cdr(drawn_reads());
  const int changes = *rc::gen::inRange(1, 5);
  for (int i = 0; i < changes; ++i) {
    bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] = *rc::gen::arbitrary<char>();
  }
  tagfield_msgs::TagReads back;
  (void)from_cdr(bytes, back);
  RC_ASSERT(back.reads.size() <= bytes.size());
}

TEST(Cdr, AbsurdLengthsTakeNoMemory) {
  tagfield_msgs::TagReads back;
  EXPECT_FALSE(from_cdr("\0\1\0\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff"s, back));
  EXPECT_FALSE(from_cdr("", back));
  EXPECT_FALSE(from_cdr("\0\0\0\0\0\0\0\0"s, back)) << "big endian";
}

}  // namespace
}  // namespace tagfield::ros2
