# SPDX-License-Identifier: Apache-2.0
# Precompiled headers: library headers that most sources include and that take longer to compile than the
# sources. -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON compiles without them.
set(tagfield_common_headers
  <algorithm> <chrono> <cmath> <filesystem> <functional> <map> <memory> <optional> <set> <span> <string>
  <unordered_map> <variant> <vector> <Eigen/Geometry>)
set(nothing ${PROJECT_BINARY_DIR}/nothing.cc)
if(NOT EXISTS ${nothing})
  file(WRITE ${nothing} "")
endif()

# tagfield_headers_once(TARGET [OPTION…]): a target whose precompiled headers others reuse. These must be compiled
# with the same options, including the optimization level.
function(tagfield_headers_once target)
  add_library(${target} OBJECT ${nothing})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${target} PRIVATE Eigen3::Eigen fmt::fmt)
  target_precompile_headers(${target} PRIVATE ${tagfield_common_headers} <fmt/format.h>)
  tagfield_warnings(${target})
  target_compile_options(${target} PRIVATE ${ARGN})
endfunction()
tagfield_headers_once(tagfield_headers)

# tagfield_read_headers_once(TARGET [<header>…]): uses these precompiled headers, or compiles its own with
# additional ones; for a library that links fmt and is position-independent. In a unity build the
# additional ones are not worth it, as they are seldom included.
function(tagfield_read_headers_once target)
  if(ARGN AND CMAKE_UNITY_BUILD)
    return()
  elseif(ARGN)
    target_precompile_headers(${target} PRIVATE ${tagfield_common_headers} <fmt/format.h> ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM tagfield_headers)
  endif()
endfunction()

# tagfield_compile_fast(TARGET): compiles code that is not performance-critical at -O1, which saves a third of the
# compile time. The target must link fmt.
set(tagfield_fast_options $<$<CONFIG:Release>:-O1>)
tagfield_headers_once(tagfield_fast_headers ${tagfield_fast_options})
function(tagfield_compile_fast target)
  # With -fPIC, like the precompiled headers, also for programs, for which CMake would use -fPIE.
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${target} PRIVATE -fPIC ${tagfield_fast_options})
  target_precompile_headers(${target} REUSE_FROM tagfield_fast_headers)
endfunction()

if(TAGFIELD_TESTS)
  # Tests run hardly more often than they are compiled, which takes a third less time at -O1. At that level
  # GCC's flow-based warnings have false positives in the standard library.
  set(tagfield_test_options $<$<CONFIG:Release>:-O1>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    list(APPEND tagfield_test_options -Wno-array-bounds -Wno-maybe-uninitialized
      -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
  add_library(tagfield_test_headers OBJECT ${nothing})
  target_link_libraries(tagfield_test_headers PRIVATE Eigen3::Eigen GTest::gtest rapidcheck)
  target_precompile_headers(tagfield_test_headers PRIVATE
    ${tagfield_common_headers} <gtest/gtest.h> <rapidcheck/gtest.h>)
  tagfield_warnings(tagfield_test_headers)
  target_compile_options(tagfield_test_headers PRIVATE ${tagfield_test_options})
endif()
