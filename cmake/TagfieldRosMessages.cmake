# SPDX-License-Identifier: Apache-2.0
# tagfield_ros1_needs(VARIABLE…): ends with one line that says how to go on where one is not found.
function(tagfield_ros1_needs)
  foreach(found IN LISTS ARGN)
    if(NOT ${found})
      message(FATAL_ERROR "ROS 1 is not complete (${found}). On Debian 12 it is in the packages "
        "libnav-msgs-dev librosbag-storage-dev libtf2-dev python3-gencpp ros-geometry-msgs "
        "ros-std-msgs; or do without rosbags: -DTAGFIELD_ROS1=OFF")
    endif()
  endforeach()
endfunction()

# tagfield_ros_messages(TARGET PACKAGE_DIR…)
#
# An interface target with the C++ headers of ROS 1 message packages, made by gencpp. Messages of
# other packages are looked for where Debian (/usr/share/PACKAGE/msg) and ROS (its share folder)
# put them.
function(tagfield_ros_messages target)
  find_program(TAGFIELD_GEN_CPP gen_cpp.py
    PATHS /usr/lib/gencpp /opt/ros/noetic/lib/gencpp)
  find_path(TAGFIELD_ROS_SHARE std_msgs/msg/Header.msg
    PATHS /usr/share /opt/ros/noetic/share)
  find_path(TAGFIELD_GENCPP_TEMPLATES msg.h.template
    PATHS /usr/share/gencpp /opt/ros/noetic/share/gencpp)
  tagfield_ros1_needs(TAGFIELD_GEN_CPP TAGFIELD_ROS_SHARE TAGFIELD_GENCPP_TEMPLATES)
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
