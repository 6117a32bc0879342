// SPDX-License-Identifier: Apache-2.0
/// @file
/// Detection of builds with sanitizers, by GCC or Clang.
#pragma once

namespace tagfield {

/// Whether this is a build with the address or thread sanitizer. These reserve terabytes of address
/// space, so a process's memory can't be limited there.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace tagfield
