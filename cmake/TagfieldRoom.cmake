# tagfield_room(NAME SOURCES a.cc … LINKS room … PRIVATE library … TESTS a_test.cc …)
#
# One room of the house: a static library tagfield_NAME, known to others as tagfield::NAME, that
# links only the rooms and libraries it is given, with its tests in test/. Headers lie beside the
# sources and are included by their path from the top of the source tree.
function(tagfield_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINKS;PRIVATE;TESTS" ${ARGN})
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
  endif()
  set_property(GLOBAL APPEND PROPERTY TAGFIELD_ROOMS ${target})
  if(TAGFIELD_TESTS AND ROOM_TESTS)
    tagfield_test(${name}_test SOURCES ${ROOM_TESTS} LINKS tagfield::${name})
  endif()
endfunction()

# tagfield_test(NAME SOURCES … LINKS …): one GoogleTest program, its cases known to ctest. RapidCheck
# draws anew in each run unless it is given a seed.
function(tagfield_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;LINKS" ${ARGN})
  list(TRANSFORM TEST_SOURCES PREPEND test/ REGEX "^[^/]+$")
  add_executable(${name} ${TEST_SOURCES})
  target_link_libraries(${name} PRIVATE ${TEST_LINKS} GTest::gtest_main rapidcheck)
  target_compile_definitions(${name} PRIVATE TAGFIELD_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  tagfield_warnings(${name})
  gtest_discover_tests(${name} TEST_PREFIX "${name}." NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 300 ENVIRONMENT "RC_PARAMS=seed=1")
endfunction()

# tagfield_compile_together(TARGET): all its sources as one, so that their headers are read once.
function(tagfield_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  # GCC takes the sources, which are included, for headers.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
endfunction()

function(tagfield_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual -Wold-style-cast -Werror)
endfunction()
