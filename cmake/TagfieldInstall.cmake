# Installs headers, libraries and the CMake package, so that another project can
#   find_package(tagfield REQUIRED)
#   target_link_libraries(program PRIVATE tagfield::simulator)
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY TAGFIELD_ROOMS)
install(TARGETS ${rooms} EXPORT tagfieldTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY tagfield DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN internal EXCLUDE PATTERN test EXCLUDE)
install(EXPORT tagfieldTargets NAMESPACE tagfield::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tagfield)
configure_package_config_file(
  ${CMAKE_CURRENT_LIST_DIR}/tagfieldConfig.cmake.in ${PROJECT_BINARY_DIR}/tagfieldConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tagfield)
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/tagfieldConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tagfieldConfig.cmake
              ${PROJECT_BINARY_DIR}/tagfieldConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tagfield)
install(DIRECTORY models profiles scenarios worlds DESTINATION ${CMAKE_INSTALL_DATADIR}/tagfield)
