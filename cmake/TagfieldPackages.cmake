# SPDX-License-Identifier: Apache-2.0
# Debian packages with CPack, one per component: scripts/package, or the target `package` of the build.
#
#   tagfield          the command, shell completions, man pages
#   tagfield-common   scenarios, worlds, profiles, models and templates
#   tagfield-mpi      sweeps under mpirun
#   libtagfield-dev   headers, static libraries and the CMake package
#   python3-tagfield  the Python package
#   tagfield-gazebo   the plugins for Gazebo 11, of a build with TAGFIELD_GAZEBO alone
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tagfield)
set(CPACK_PACKAGE_VENDOR "Tagfield")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # Each package has its own.
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Tagfield authors <tagfield@example.org>" CACHE STRING
  "Who answers for the packages")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(notes ${PROJECT_BINARY_DIR}/packages_notes)
# A changelog in Debian's format that refers to CHANGELOG.md. Its date is that of the commit, for reproducible
# packages.
set(date "Thu, 01 Jan 1970 00:00:00 +0000")
find_program(git git)
if(git AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(COMMAND ${git} -C ${PROJECT_SOURCE_DIR} log -1 --format=%aD
    OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
find_program(TAGFIELD_GZIP gzip)

# tagfield_package(COMPONENT NAME SECTION … SUMMARY … DESCRIPTION … [DEPENDS …] [RECOMMENDS …] [SUGGESTS …])
macro(tagfield_package component name)
  cmake_parse_arguments(PACKAGE "" "SECTION;SUMMARY;DESCRIPTION" "DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${PACKAGE_SECTION})
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${PACKAGE_SUMMARY}\n${PACKAGE_DESCRIPTION}")
  foreach(relation DEPENDS RECOMMENDS SUGGESTS)
    string(REPLACE ";" ", " CPACK_DEBIAN_${upper}_PACKAGE_${relation} "${PACKAGE_${relation}}")
  endforeach()
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  file(WRITE ${notes}/${name}/changelog
    "${name} (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md.\n\n"
    " -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}\n")
  if(TAGFIELD_GZIP)
    execute_process(COMMAND ${TAGFIELD_GZIP} -9nf ${notes}/${name}/changelog)
  endif()
  install(DIRECTORY ${notes}/${name}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/copyright ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

set(CPACK_COMPONENTS_ALL "")
if(TAGFIELD_COMMAND)
  tagfield_loaded_packages(loaded tagfield_archive tagfield_epcis tagfield_layout tagfield_mqtt tagfield_ros2_dds)
  tagfield_package(data tagfield-common SECTION science
    SUMMARY "simulator of UHF RFID: scenarios, worlds, profiles"
    DESCRIPTION "Scenarios, worlds, profiles of readers, antennas and tags, models for Gazebo\n\
and templates, which the command tagfield and the Python package use.")
  set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
  tagfield_package(command tagfield SECTION science
    SUMMARY "simulator of UHF RFID: tags, readers, phase and RSSI"
    DESCRIPTION "Simulates tags and reader antennas anywhere in a world, fixed or moving,\n\
with the phase and RSSI of each read, and locates the tags from them; plans\n\
where antennas go, compares localization methods, and serves a live world\n\
over HTTP, LLRP, MQTT and ROS 2."
    DEPENDS "tagfield-common (= ${PROJECT_VERSION})"
    RECOMMENDS bash-completion man-db ${loaded}
    SUGGESTS python3-tagfield tagfield-mpi chromium mosquitto)
  if(TARGET tagfield_sweep_mpi)
    tagfield_package(mpi tagfield-mpi SECTION science
      SUMMARY "simulator of UHF RFID: sweeps under mpirun"
      DESCRIPTION "The program tagfield_sweep_mpi, which does the sweeps of 'tagfield sweep'\n\
with all ranks of an MPI program."
      DEPENDS openmpi-bin "tagfield (= ${PROJECT_VERSION})")
  endif()
  tagfield_package(dev libtagfield-dev SECTION libdevel
    SUMMARY "simulator of UHF RFID: headers and static libraries"
    DESCRIPTION "Headers, static libraries and the CMake package for programs that simulate\n\
UHF RFID themselves: find_package(tagfield COMPONENTS simulator)."
    # The packages that cmake/TagfieldComponents.cmake looks for, and what they need without depending on it.
    DEPENDS libeigen3-dev libfmt-dev "tagfield-common (= ${PROJECT_VERSION})"
    RECOMMENDS cmake g++ pkg-config libassimp-dev libcsv-dev libdraco-dev libembree-dev libminizip-dev
      libpng-dev libpolyclipping-dev libtinyxml2-dev libyaml-cpp-dev zlib1g-dev coinor-libcbc-dev)
endif()
if(TARGET tagfield_python)
  # Set by python/CMakeLists.txt.
  get_target_property(python_version tagfield_python TAGFIELD_PYTHON_VERSION)
  string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" python_version "${python_version}")
  math(EXPR next_minor "${CMAKE_MATCH_2} + 1")
  tagfield_loaded_packages(loaded tagfield_archive tagfield_layout)
  tagfield_package(python python3-tagfield SECTION python
    SUMMARY "simulator of UHF RFID: Python package"
    DESCRIPTION "The package tagfield for Python: runs as NumPy arrays, worlds and scenarios\n\
made in Python, localization methods and outlets as functions, plots."
    DEPENDS "python3 (>= ${python_version})"
      "python3 (<< ${CMAKE_MATCH_1}.${next_minor})" python3-numpy
      "tagfield-common (= ${PROJECT_VERSION})"
    RECOMMENDS python3-matplotlib python3-pandas ${loaded}
    SUGGESTS tagfield)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/packaging/python3-tagfield/postinst
    ${PROJECT_SOURCE_DIR}/packaging/python3-tagfield/prerm)
endif()
if(TAGFIELD_GAZEBO AND NOT TAGFIELD_COMMAND)
  tagfield_package(gazebo tagfield-gazebo SECTION science
    SUMMARY "simulator of UHF RFID: plugins for Gazebo 11 with ROS 1"
    DESCRIPTION "Plugins that put UHF RFID tags and reader antennas into worlds of Gazebo 11,\n\
with reads as ROS 1 messages and MCAP files, and models of antennas and tags."
    DEPENDS gazebo
    SUGGESTS tagfield)
endif()
if(CPACK_COMPONENTS_ALL)
  include(CPack)
endif()
