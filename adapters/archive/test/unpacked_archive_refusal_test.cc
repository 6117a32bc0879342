// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "adapters/archive/unpacked_archive.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

TEST(ArchiveRefusal, SaysWhatIsMissing) {
  EXPECT_TRUE(is_archive("run.tar.zst"));
  try {
    const UnpackedArchive unpacked("run.tar.zst");
    FAIL() << "it was unpacked";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "run.tar.zst: is compressed, and this tagfield was built without libarchive: "
                 "unpack it first");
  }
}

}  // namespace
}  // namespace tagfield
