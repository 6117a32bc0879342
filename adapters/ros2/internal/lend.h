// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of C++ messages to C structs that point at the messages' contents, valid as long as
/// these live.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "adapters/ros2/dds_types.h"

namespace tagfield::ros2 {

/// Owns the lists of structs that have to be newly created.
class Arena {
 public:
  template <class T>
  T* list_of(std::size_t length) {
    lists_.push_back(std::make_unique<std::byte[]>(length * sizeof(T)));
    return reinterpret_cast<T*>(lists_.back().get());
  }

 private:
  std::vector<std::unique_ptr<std::byte[]>> lists_;  // Zeros; new aligns for any T.
};

inline void lend(const std::string& text, char*& target, Arena&) {
  target = const_cast<char*>(text.c_str());
}

/// A bounded string is stored within its struct; longer text is truncated.
template <std::size_t N>
void copy_text(const std::string& text, char (&target)[N]) {
  const std::size_t length = std::min(text.size(), N - 1);
  std::copy_n(text.begin(), length, target);
  target[length] = '\0';
}

template <class T, class Sequence>
void lend_numbers(const std::vector<T>& values, Sequence& target) {
  target._maximum = target._length = static_cast<std::uint32_t>(values.size());
  target._buffer = const_cast<T*>(values.data());
  target._release = false;
}

/// `lend` of the elements is found by argument-dependent lookup on instantiation.
template <class C, class T, class Sequence>
void lend_list(const std::vector<T>& values, Sequence& target, Arena& arena) {
  target._maximum = target._length = static_cast<std::uint32_t>(values.size());
  target._buffer = arena.list_of<C>(values.size());
  target._release = false;
  for (std::size_t i = 0; i < values.size(); ++i) lend(values[i], target._buffer[i], arena);
}

template <class Message, class C>
DdsType entry(const dds_topic_descriptor_t& descriptor) {
  return {&descriptor, [](const void* message, const std::function<void(const void*)>& use) {
            Arena arena;
            C target{};
            lend(*static_cast<const Message*>(message), target, arena);
            use(&target);
          }};
}

}  // namespace tagfield::ros2
