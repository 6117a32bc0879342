# SPDX-License-Identifier: Apache-2.0
# tagfield_room(NAME SOURCES a.cc … PUBLIC_HEADERS a.h … LINKS room … PRIVATE library …
#               TESTS a_test.cc … TEST_PARTS n [COMPILE_FAST])
#
# One room of the house: a static library tagfield_NAME, known to others as tagfield::NAME, that
# links only the rooms and libraries it is given, with its tests in test/. Headers lie beside the
# sources and are included by their path from the top of the source tree; PUBLIC_HEADERS are for users'
# programs too (docs/api.md). COMPILE_FAST: nothing in it takes long (tagfield_compile_fast).
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
  # For the plugins the core is compiled once more; there each room at one go.
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

# tagfield_public_headers(ROOM a.h …): are installed, under include/tagfield/ROOM/.
function(tagfield_public_headers room)
  foreach(header IN LISTS ARGN)
    get_filename_component(folder tagfield/${room}/${header} DIRECTORY)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT dev)
  endforeach()
endfunction()

# tagfield_plain_arithmetic(TARGET): no errno and no exceptions' flags from mathematical functions, no
# product and sum in one instruction, and complex numbers are multiplied and divided without a look for
# infinities, which never come in. So compilers find vector instructions for loops, and results are the
# same bits in all of them (tagfield/base/lanes.h).
function(tagfield_plain_arithmetic target)
  target_compile_options(${target} PRIVATE
    -fno-math-errno -fno-trapping-math -ffp-contract=off
    $<$<CXX_COMPILER_ID:GNU>:-fcx-limited-range>)
  # Headers read once for all were read without these.
  set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
endfunction()

# tagfield_test(NAME SOURCES … LINKS … [PARTS n]): one GoogleTest program, to ctest one test or as many
# as there are parts, between which its cases are dealt: to load the libraries for each case alone would
# take longer than most cases. RapidCheck draws anew in each run unless it is given a seed.
function(tagfield_test name)
  cmake_parse_arguments(TEST "" "PARTS" "SOURCES;LINKS" ${ARGN})
  list(TRANSFORM TEST_SOURCES PREPEND test/ REGEX "^[^/]+$")
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_LINKS} GTest::gtest_main rapidcheck)
  target_compile_definitions(${name} PRIVATE TAGFIELD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_precompile_headers(${name} REUSE_FROM tagfield_test_headers)
  tagfield_warnings(${name})
  target_compile_options(${name} PRIVATE ${tagfield_test_options})
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
      set(cost 100)  # long: not to be left over at the end
    endif()
    math(EXPR index "${part} - 1")
    add_test(NAME ${test} COMMAND ${name})
    set_tests_properties(${test} PROPERTIES TIMEOUT 1200 COST ${cost}
      ENVIRONMENT "RC_PARAMS=seed=1;GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()

# tagfield_compile_together(TARGET): all its sources as one, so that their headers are read once.
function(tagfield_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  target_compile_options(${target} PRIVATE ${tagfield_unity_options})
endfunction()

# GCC takes sources that are included for headers; and what one source names globally may be the name of
# something local in another.
set(tagfield_unity_options -Wno-subobject-linkage -Wno-shadow -Wshadow=local)

function(tagfield_warnings target)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()  # Another compiler has other things to say; these are kept clean by GCC and clang-tidy.
  endif()
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual -Wold-style-cast $<$<BOOL:${TAGFIELD_WERROR}>:-Werror>)
  # From version 13 on GCC warns of every reference that a function gives where one of its arguments is a temporary,
  # such as a name that is looked for.
  if(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    target_compile_options(${target} PRIVATE -Wno-dangling-reference)
  endif()
  # Before version 12 it took the value of an optional that is looked at first for one that may not be there.
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 12)
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
  if(CMAKE_UNITY_BUILD)
    target_compile_options(${target} PRIVATE ${tagfield_unity_options})
  endif()
endfunction()
