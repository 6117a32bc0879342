# SPDX-License-Identifier: Apache-2.0
# The robot and the lift.
add_library(tagfield_gazebo_robot STATIC laser.cc lift_drive.cc skid_steer.cc)
target_link_libraries(tagfield_gazebo_robot PUBLIC tagfield_gazebo)
tagfield_in_gazebo(tagfield_gazebo_robot)
tagfield_compile_together(tagfield_gazebo_robot)

foreach(name Robot Lift)
  string(TOLOWER ${name} file)
  add_library(Tagfield${name}Plugin SHARED plugins/${file}_plugin.cc)
  target_link_libraries(Tagfield${name}Plugin
    PRIVATE tagfield_gazebo_robot tagfield_ros1_robot)
  tagfield_in_gazebo(Tagfield${name}Plugin)
endforeach()
