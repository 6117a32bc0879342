# SPDX-License-Identifier: Apache-2.0
# Installs libraries and the CMake package (each room installs its own headers), so that another project can
#   find_package(tagfield REQUIRED COMPONENTS simulator)
#   target_link_libraries(program PRIVATE tagfield::simulator)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/tagfield)
foreach(component IN LISTS tagfield_built)
  set(rooms ${tagfield_${component}_ROOMS})
  list(TRANSFORM rooms PREPEND tagfield_)
  install(TARGETS ${rooms} EXPORT tagfield-${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(EXPORT tagfield-${component} NAMESPACE tagfield:: DESTINATION ${package} COMPONENT dev)
endforeach()
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/tagfieldConfig.cmake.in ${PROJECT_BINARY_DIR}/tagfieldConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/tagfieldConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tagfieldConfig.cmake
              ${PROJECT_BINARY_DIR}/tagfieldConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/TagfieldComponents.cmake
        DESTINATION ${package} COMPONENT dev)
if(TAGFIELD_COMMAND)
  install(DIRECTORY models profiles scenarios templates worlds
    DESTINATION ${CMAKE_INSTALL_DATADIR}/tagfield COMPONENT data)
  install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tagfield-common COMPONENT data
    USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)
  install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/tagfield-common COMPONENT data
    PATTERN __pycache__ EXCLUDE PATTERN site EXCLUDE)
endif()
include(TagfieldPackages)
