# SPDX-License-Identifier: Apache-2.0
# Headers of libraries that most sources include, which take longer to read than the sources: they are
# read once for all. -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON reads each source as it stands.
set(tagfield_common_headers
  <algorithm> <cmath> <filesystem> <functional> <map> <memory> <optional> <string> <vector>
  <Eigen/Geometry>)
set(nothing ${PROJECT_BINARY_DIR}/nothing.cc)
if(NOT EXISTS ${nothing})
  file(WRITE ${nothing} "")
endif()

# tagfield_headers_once(TARGET [OPTION…]): a target whose headers others reuse. Its options are theirs, too: the level
# of optimization is that at which headers were read.
function(tagfield_headers_once target)
  add_library(${target} OBJECT ${nothing})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${target} PRIVATE Eigen3::Eigen fmt::fmt)
  target_precompile_headers(${target} PRIVATE ${tagfield_common_headers} <fmt/format.h>)
  tagfield_warnings(${target})
  target_compile_options(${target} PRIVATE ${ARGN})
endfunction()
tagfield_headers_once(tagfield_headers)

# tagfield_read_headers_once(TARGET [<header>…]): those, and more if there are; of a library that links
# fmt and is of position-independent code. A unity build reads those others seldom as it is.
function(tagfield_read_headers_once target)
  if(ARGN AND CMAKE_UNITY_BUILD)
    return()
  elseif(ARGN)
    target_precompile_headers(${target} PRIVATE ${tagfield_common_headers} <fmt/format.h> ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM tagfield_headers)
  endif()
endfunction()

# tagfield_compile_fast(TARGET): what doesn't take long when it runs is not to take long to compile either: -O1 saves
# a third. Links fmt.
set(tagfield_fast_options $<$<CONFIG:Release>:-O1>)
tagfield_headers_once(tagfield_fast_headers ${tagfield_fast_options})
function(tagfield_compile_fast target)
  # As the headers were read, of programs, too, for which CMake would say -fPIE.
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${target} PRIVATE -fPIC ${tagfield_fast_options})
  target_precompile_headers(${target} REUSE_FROM tagfield_fast_headers)
endfunction()

if(TAGFIELD_TESTS)
  # Tests run hardly more often than they are compiled, which takes a third less time at -O1. There GCC's
  # warnings that follow the flow of values see faults in the standard library where none are.
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
