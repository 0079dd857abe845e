# SPDX-License-Identifier: Apache-2.0
# Half of the time of compiling the offline half and its tests goes into reading the same headers of other libraries.
# They are read once, into three precompiled headers: what every room of the offline half uses; that and the JSON
# library, for rooms that print it; that and GoogleTest, for tests. Loading a header that is not used costs every file
# some tenths of a second, hence three.
option(PLUMB_PRECOMPILED "Read the headers of other libraries once (GCC)" ${PROJECT_IS_TOP_LEVEL})

# plumb_precompiled_header(NAME LIBS... HEADERS...)
function(plumb_precompiled_header name)
  cmake_parse_arguments(arg "" "" "LIBS;HEADERS" ${ARGN})
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${name} PRIVATE plumb_options Eigen3::Eigen fmt::fmt ${arg_LIBS})
  # The physics is computed alike everywhere (Plumb::runtime).
  target_compile_options(${name} PRIVATE -ffp-contract=off)
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numeric> <optional>
    <random> <set> <span> <string> <string_view> <tuple> <variant> <vector>
    <Eigen/Dense> <fmt/format.h> <fmt/ranges.h> ${arg_HEADERS})
endfunction()

if(PLUMB_PRECOMPILED AND PLUMB_OFFLINE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CROSSCOMPILING)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  if(NOT EXISTS ${CMAKE_BINARY_DIR}/precompiled.cpp)  # touched only once: all that reads it is compiled after it
    file(WRITE ${CMAKE_BINARY_DIR}/precompiled.cpp "")
  endif()
  plumb_precompiled_header(plumb_precompiled)
  plumb_precompiled_header(plumb_precompiled_json LIBS nlohmann_json::nlohmann_json HEADERS <nlohmann/json.hpp>)
  if(PLUMB_TESTS)
    find_package(GTest REQUIRED)
    # Tests of the offline half call what is optimised and compute little themselves: compiling them as carefully takes
    # half as long again. A header is read precompiled only by what is optimised alike.
    if(CMAKE_BUILD_TYPE STREQUAL "Release")
      set(PLUMB_TEST_OPTIMISATION -O1)
    endif()
    plumb_precompiled_header(plumb_precompiled_tests LIBS nlohmann_json::nlohmann_json GTest::gtest
                             HEADERS <nlohmann/json.hpp> <gtest/gtest.h>)
    target_compile_options(plumb_precompiled_tests PRIVATE ${PLUMB_TEST_OPTIMISATION})
  endif()
endif()

# plumb_use_precompiled_headers(TARGET [json|tests]): reads them from there. Position-independent code as there: an
# executable may consist of it too.
function(plumb_use_precompiled_headers target)
  if(NOT TARGET plumb_precompiled)
    return()
  endif()
  set(header plumb_precompiled)
  if(ARGC GREATER 1)
    set(header plumb_precompiled_${ARGV1})
    target_link_libraries(${target} PRIVATE nlohmann_json::nlohmann_json)
    if(ARGV1 STREQUAL "tests")
      target_compile_options(${target} PRIVATE ${PLUMB_TEST_OPTIMISATION})
    endif()
  endif()
  target_link_libraries(${target} PRIVATE Eigen3::Eigen fmt::fmt)
  # With it GCC 12 inlines more of std::string, and sees copies of impossible sizes that are none (GCC bug 105329).
  target_compile_options(${target} PRIVATE -fPIC -Wno-stringop-overflow)
  target_precompile_headers(${target} REUSE_FROM ${header})
endfunction()
