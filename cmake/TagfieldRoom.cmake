# SPDX-License-Identifier: Apache-2.0
# tagfield_room(NAME SOURCES a.cc … PUBLIC_HEADERS a.h … LINKS room … PRIVATE library …
#               TESTS a_test.cc … TEST_PARTS n [COMPILE_FAST])
#
# One room, which is a source directory in tagfield/: a static library tagfield_NAME with the alias
# tagfield::NAME, which links only the given rooms and libraries, with its tests in test/. Headers are
# next to the sources and included by their path from the top of the source tree; PUBLIC_HEADERS are also
# for users' programs (docs/api.md). COMPILE_FAST: it is not performance-critical (tagfield_compile_fast).
function(tagfield_room name)
  cmake_parse_arguments(ROOM "COMPILE_FAST" "TEST_PARTS"
    "SOURCES;PUBLIC_HEADERS;LINKS;PRIVATE;TESTS" ${ARGN})
  foreach(link IN LISTS ROOM_LINKS)
    if(link MATCHES "^tagfield::" AND NOT TARGET ${link})
      message(FATAL_ERROR "tagfield/${name} links ${link}, which is in no component that it needs")
    endif()
  endforeach()
  set(target tagfield_${name})
  add_library(${target} STATIC ${ROOM_SOURCES})
  add_library(tagfield::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE})
  tagfield_warnings(${target})
  # The core is compiled separately for the plugins; there each room is one translation unit.
  if(TAGFIELD_GAZEBO AND NOT TAGFIELD_COMMAND)
    tagfield_compile_together(${target})
  elseif(ROOM_COMPILE_FAST)
    tagfield_compile_fast(${target})
  else()
    tagfield_read_headers_once(${target})
  endif()
  tagfield_public_headers(${name} ${ROOM_PUBLIC_HEADERS})
  if(TAGFIELD_TESTS AND ROOM_TESTS)
    tagfield_test(${name}_test SOURCES ${ROOM_TESTS} LINKS tagfield::${name}
                  PARTS ${ROOM_TEST_PARTS})
  endif()
endfunction()

# tagfield_public_headers(ROOM a.h …): installs them in include/tagfield/ROOM/.
function(tagfield_public_headers room)
  foreach(header IN LISTS ARGN)
    get_filename_component(folder tagfield/${room}/${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT dev)
  endforeach()
endfunction()

# tagfield_plain_arithmetic(TARGET): mathematical functions set neither errno nor floating-point exception
# flags, there is no fused multiply-add, and complex multiplication and division do not check for
# infinities, which never occur. This lets compilers vectorize loops, with bitwise identical results for
# all instruction sets (tagfield/base/lanes.h).
function(tagfield_plain_arithmetic target)
  target_compile_options(${target} PRIVATE
    -fno-math-errno -fno-trapping-math -ffp-contract=off
    $<$<CXX_COMPILER_ID:GNU>:-fcx-limited-range>)
  # The precompiled headers were compiled without these options.
  set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
endfunction()

# tagfield_test(NAME SOURCES … LINKS … [PARTS n]): one GoogleTest program, registered with ctest as one
# test or as n parts (shards), but not by test case: loading the libraries takes longer than most cases.
# RapidCheck has a fixed seed, as it would draw new values in each run otherwise.
function(tagfield_test name)
  cmake_parse_arguments(TEST "" "PARTS" "SOURCES;LINKS" ${ARGN})
  list(TRANSFORM TEST_SOURCES PREPEND test/ REGEX "^[^/]+$")
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_LINKS} GTest::gtest_main rapidcheck)
  target_compile_definitions(${name} PRIVATE TAGFIELD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_precompile_headers(${name} REUSE_FROM tagfield_test_headers)
  tagfield_warnings(${name})
  target_compile_options(${name} PRIVATE ${tagfield_test_options})
  # Twice as many at a time as of the libraries' sources take a quarter less time.
  set_target_properties(${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 16)
  tagfield_gtest(${name} ${TEST_PARTS})
endfunction()

# tagfield_gtest(PROGRAM [PARTS])
function(tagfield_gtest name)
  set(parts 1 ${ARGN})
  list(GET parts -1 count)
  foreach(part RANGE 1 ${count})
    set(test ${name})
    set(cost 10)
    if(count GREATER 1)
      set(test ${name}.${part})
      set(cost 100)  # long: must not run alone at the end
    endif()
    math(EXPR index "${part} - 1")
    add_test(NAME ${test} COMMAND ${name})
    set_tests_properties(${test} PROPERTIES TIMEOUT 1200 COST ${cost}
      ENVIRONMENT "RC_PARAMS=seed=1;GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# tagfield_compile_together(TARGET): compiles all its sources as one, so that headers are parsed once.
function(tagfield_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  target_compile_options(${target} PRIVATE ${tagfield_unity_options})
endfunction()

# In a unity build GCC treats included sources as headers, and a local name in one source may shadow a global
# name of another.
set(tagfield_unity_options -Wno-subobject-linkage -Wno-shadow -Wshadow=local)

function(tagfield_warnings target)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()  # Other compilers have other warnings; the sources are kept clean with GCC and clang-tidy.
  endif()
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual -Wold-style-cast $<$<BOOL:${TAGFIELD_WERROR}>:-Werror>)
  # From version 13 on GCC warns of every reference returned by a function with a temporary among its arguments,
  # such as the key of a lookup.
  if(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    target_compile_options(${target} PRIVATE -Wno-dangling-reference)
  endif()
  # Before version 12 GCC reported the value of an optional as maybe uninitialized even after a check of it.
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
  if(CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE ${tagfield_unity_options})
  else()
    # What a unity build takes is taken without one, too.
    target_compile_options(${target} PRIVATE -Wno-shadow -Wshadow=local)
  endif()
endfunction()
