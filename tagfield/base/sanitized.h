// SPDX-License-Identifier: Apache-2.0
#pragma once

/// TAGFIELD_SANITIZED is defined in a build with the address or thread sanitizer, which reserve
/// address space by the terabyte: what limits a process's memory does not go together with them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TAGFIELD_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TAGFIELD_SANITIZED 1
#endif
#endif
