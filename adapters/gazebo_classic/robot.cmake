# The robot and the lift.
add_library(tagfield_gazebo_robot STATIC
  laser.cc lift_drive.cc plugin_elements.cc skid_steer.cc)
set_target_properties(tagfield_gazebo_robot PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_include_directories(tagfield_gazebo_robot SYSTEM PUBLIC ${GAZEBO_INCLUDE_DIRS})
target_link_directories(tagfield_gazebo_robot PUBLIC ${GAZEBO_LIBRARY_DIRS})
target_link_libraries(tagfield_gazebo_robot
  PUBLIC tagfield::motion tagfield::poses ${GAZEBO_LIBRARIES} PRIVATE fmt::fmt)
tagfield_warnings(tagfield_gazebo_robot)

if(NOT TARGET PkgConfig::ros1)  # of adapters/ros1, where it is known to that folder alone
  pkg_check_modules(ros1 REQUIRED IMPORTED_TARGET
    roscpp rosgraph_msgs sensor_msgs nav_msgs tf2_msgs visualization_msgs)
endif()
# Debian's message headers are of C++17 at most: they use what C++20 took out of std::allocator.
add_library(tagfield_ros1_robot STATIC ${PROJECT_SOURCE_DIR}/adapters/ros1/robot_publisher.cc)
set_target_properties(tagfield_ros1_robot PROPERTIES POSITION_INDEPENDENT_CODE ON)
set_target_properties(tagfield_ros1_robot PROPERTIES CXX_STANDARD 17)
target_include_directories(tagfield_ros1_robot PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(tagfield_ros1_robot
  PRIVATE PkgConfig::ros1 Eigen3::Eigen INTERFACE tagfield_ros1 tagfield::motion)
tagfield_warnings(tagfield_ros1_robot)

foreach(name Robot Lift)
  string(TOLOWER ${name} file)
  add_library(Tagfield${name}Plugin SHARED plugins/${file}_plugin.cc)
  target_link_libraries(Tagfield${name}Plugin
    PRIVATE tagfield_gazebo_robot tagfield_ros1_robot fmt::fmt)
  set_target_properties(Tagfield${name}Plugin PROPERTIES INSTALL_RPATH $ORIGIN)
  tagfield_warnings(Tagfield${name}Plugin)
endforeach()
