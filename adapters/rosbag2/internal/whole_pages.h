// SPDX-License-Identifier: Apache-2.0
/// @file
/// Databases that were truncated in the middle of a page.
#pragma once

namespace tagfield::rosbag2_internal {

/// The name of an SQLite VFS that hides a partial page at the end of a database, which SQLite would
/// fill up with zeros and take for messages. It neither locks nor creates files.
const char* whole_pages();

}  // namespace tagfield::rosbag2_internal
