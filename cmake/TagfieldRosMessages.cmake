# SPDX-License-Identifier: Apache-2.0
# What of ROS 1 is used, where Debian or ROS itself put it.
set(tagfield_ros1_bag_libraries rosbag_storage roslz4 bz2 tf2 class_loader console_bridge)

# tagfield_ros1_modules(PREFIX [QUIET] [REQUIRED] [GLOBAL] MODULE…): PkgConfig::PREFIX, where the modules are found.
# Debian 13's file for rostime names the folder /include, which there is none of, and which CMake would refuse; the
# headers are in /usr/include.
function(tagfield_ros1_modules prefix)
  pkg_check_modules(${prefix} IMPORTED_TARGET ${ARGN})
  if(TARGET PkgConfig::${prefix})
    get_target_property(named PkgConfig::${prefix} INTERFACE_INCLUDE_DIRECTORIES)
    set(there "")
    foreach(folder IN LISTS named)
      if(IS_DIRECTORY "${folder}")
        list(APPEND there ${folder})
      endif()
    endforeach()
    set_target_properties(PkgConfig::${prefix} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${there}")
  endif()
  set(${prefix}_FOUND "${${prefix}_FOUND}" PARENT_SCOPE)
endfunction()

# tagfield_find_ros1(MISSING): what messages are made of, PkgConfig::ros1_messages and, for the command,
# PkgConfig::ros1_bag and the libraries that read bags, TAGFIELD_<library>. MISSING: those that are not found.
function(tagfield_find_ros1 missing)
  find_program(TAGFIELD_GEN_CPP gen_cpp.py
    PATHS /usr/lib/gencpp /opt/ros/noetic/lib/gencpp)
  find_path(TAGFIELD_ROS_SHARE std_msgs/msg/Header.msg
    PATHS /usr/share /opt/ros/noetic/share)
  find_path(TAGFIELD_GENCPP_TEMPLATES msg.h.template
    PATHS /usr/share/gencpp /opt/ros/noetic/share/gencpp)
  tagfield_ros1_modules(ros1_messages roscpp_serialization std_msgs geometry_msgs)
  set(needed TAGFIELD_GEN_CPP TAGFIELD_ROS_SHARE TAGFIELD_GENCPP_TEMPLATES ros1_messages_FOUND)
  if(TAGFIELD_COMMAND)
    foreach(library IN LISTS tagfield_ros1_bag_libraries)
      find_library(TAGFIELD_${library} ${library} PATHS /opt/ros/noetic/lib)
      list(APPEND needed TAGFIELD_${library})
    endforeach()
    tagfield_ros1_modules(ros1_bag roscpp_serialization nav_msgs tf2_msgs rostime)
    list(APPEND needed ros1_bag_FOUND)
  endif()
  set(absent "")
  foreach(variable IN LISTS needed)
    if(NOT ${variable})
      list(APPEND absent ${variable})
    endif()
  endforeach()
  set(${missing} "${absent}" PARENT_SCOPE)
endfunction()

# tagfield_ros_messages(TARGET PACKAGE_DIR…)
#
# An interface target with the C++ headers of ROS 1 message packages, made by gencpp. Messages of
# other packages are looked for where Debian (/usr/share/PACKAGE/msg) and ROS (its share folder)
# put them.
function(tagfield_ros_messages target)
  set(include_dir ${PROJECT_BINARY_DIR}/ros_messages/${target})
  set(headers "")
  foreach(package_dir IN LISTS ARGN)
    get_filename_component(package ${package_dir} NAME)
    file(GLOB messages CONFIGURE_DEPENDS ${package_dir}/msg/*.msg)
    foreach(message IN LISTS messages)
      get_filename_component(name ${message} NAME_WE)
      set(header ${include_dir}/${package}/${name}.h)
      add_custom_command(OUTPUT ${header}
        COMMAND /usr/bin/python3 ${TAGFIELD_GEN_CPP} ${message}
          -I${package}:${package_dir}/msg
          -Istd_msgs:${TAGFIELD_ROS_SHARE}/std_msgs/msg
          -Igeometry_msgs:${TAGFIELD_ROS_SHARE}/geometry_msgs/msg
          -p ${package} -o ${include_dir}/${package} -e ${TAGFIELD_GENCPP_TEMPLATES}
        DEPENDS ${messages} VERBATIM)
      list(APPEND headers ${header})
    endforeach()
  endforeach()
  add_custom_target(${target}_headers DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} SYSTEM INTERFACE ${include_dir})
endfunction()
