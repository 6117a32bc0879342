// SPDX-License-Identifier: Apache-2.0
/// @file
/// Databases that were cut off in the middle of a page.
#pragma once

namespace tagfield::rosbag2_internal {

/// The name of a way for SQLite to open files (a VFS) that shows databases without the part of a
/// page at their end, which it would fill up with zeros and take for messages. No file is locked,
/// or made.
const char* whole_pages();

}  // namespace tagfield::rosbag2_internal
