// SPDX-License-Identifier: Apache-2.0
/// @file
/// Atomic replacement of a folder of results by a new one.
#pragma once

#include <filesystem>

#include "tagfield/files/staged_folder.h"

namespace tagfield::files_internal {

/// Replaces `folder` by `staging`, a folder inside of it, with one system call: observers see
/// either all of the one or all of the other. Earlier files in `kept` are in both. The caller holds
/// the locks on both.
///
/// Returns false, with nothing changed, if that is impossible: `folder` contains files that are not
/// in `own` (foreign files, a run in progress), it contains the process's current folder, it is a
/// mount point, its parent is not writable, or the file system can't swap folders.
bool swap_in(const std::filesystem::path& folder, const std::filesystem::path& staging,
             const OwnFiles& own, const OwnFiles& kept);

/// Deletes leftovers beside `folder` of programs that were killed during swap_in().
void remove_swap_leftovers(const std::filesystem::path& folder);

}  // namespace tagfield::files_internal
