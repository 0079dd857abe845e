# SPDX-License-Identifier: Apache-2.0
# The examples against the installed libraries, in a copy of this folder:
#   cp -r /usr/share/doc/libplumb-dev/examples . && cmake -S examples -B build && cmake --build build
#   build/01_correct_one_pose examples/planar_2r.plumb && build/05_from_c examples/planar_2r.plumb
cmake_minimum_required(VERSION 3.25)
project(plumb_examples LANGUAGES C CXX)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_STANDARD 20)
find_package(Plumb REQUIRED)
find_package(Threads REQUIRED)
# They name each other as examples/..., so this folder is to keep its name.
cmake_path(GET CMAKE_CURRENT_SOURCE_DIR PARENT_PATH above)
file(GLOB sources ${CMAKE_CURRENT_SOURCE_DIR}/0*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/0*.c)
foreach(source ${sources})
  cmake_path(GET source STEM name)
  add_executable(${name} ${source})
  target_include_directories(${name} PRIVATE ${above})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${name} PRIVATE Plumb::robot Plumb::c Plumb::runtime Plumb::format Plumb::drivers Threads::Threads)
endforeach()
