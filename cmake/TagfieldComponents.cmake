# SPDX-License-Identifier: Apache-2.0
# The components that can be built, installed and found separately, for Tagfield's own build and for
# find_package():
#
#   cmake -DTAGFIELD_COMPONENTS="localization;files" …
#   find_package(tagfield REQUIRED COMPONENTS localization files)
#
# A component consists of some rooms, the packages that a program needs to link them (PACKAGES of CMake,
# MODULES of pkg-config), and the earlier components that they depend on (NEEDS).

# Embree 3 or, if that is missing, 4: its CMake package may reject a search without a version.
find_package(embree 3 QUIET)
set(tagfield_embree "embree 4")
if(embree_FOUND)
  set(tagfield_embree "embree 3")
endif()

set(tagfield_components "")
macro(tagfield_component name)
  list(APPEND tagfield_components ${name})
  cmake_parse_arguments(tagfield_${name} "" "" "NEEDS;ROOMS;PACKAGES;MODULES" ${ARGN})
endmacro()

tagfield_component(core ROOMS base poses stream epc PACKAGES Threads "Eigen3 3.3" fmt)
tagfield_component(files NEEDS core ROOMS files)
tagfield_component(motion NEEDS core ROOMS motion)
tagfield_component(localization NEEDS core ROOMS fit localization tracking calibration)
tagfield_component(field NEEDS core
  ROOMS world propagation channel gen2 reader settings field PACKAGES "${tagfield_embree}")
tagfield_component(sdf NEEDS files field ROOMS sdf PACKAGES assimp PNG MODULES tinyxml2)
tagfield_component(navigation NEEDS files motion field ROOMS map laser navigation
  PACKAGES yaml-cpp MODULES polyclipping)
tagfield_component(report NEEDS files localization navigation ROOMS report)
tagfield_component(scenario NEEDS files localization sdf navigation ROOMS scenario)
tagfield_component(events NEEDS scenario ROOMS events)
tagfield_component(simulator NEEDS scenario ROOMS simulator)
tagfield_component(planning NEEDS report simulator ROOMS planning layout PACKAGES ZLIB)
tagfield_component(experiment NEEDS report simulator ROOMS experiment)
tagfield_component(live NEEDS planning ROOMS live)

# tagfield_with_needs(OUT COMPONENT…): the components and all their dependencies, in the order above. Unknown
# names stay at the front.
function(tagfield_with_needs out)
  set(found "")
  set(todo ${ARGN})
  while(todo)
    list(POP_FRONT todo name)
    list(APPEND found ${name})
    list(APPEND todo ${tagfield_${name}_NEEDS})
  endwhile()
  set(unknown ${found})
  list(REMOVE_ITEM unknown ${tagfield_components})
  set(others ${tagfield_components})
  list(REMOVE_ITEM others ${found})
  set(needed ${tagfield_components})
  list(REMOVE_ITEM needed "" ${others})
  set(${out} ${unknown} ${needed} PARENT_SCOPE)
endfunction()
