# SPDX-License-Identifier: Apache-2.0
# Half of the time of compiling the offline half and its tests goes into reading the same headers of other libraries.
# They are read once, into three precompiled headers: what every room uses that computes; that and the JSON library, for
# rooms that read and print; that and GoogleTest, for tests. Loading a header that is not used costs every file some
# tenths of a second, hence three.
#
# What reads and prints is compiled with -O1, and so are the tests, which call what is optimised: a fifth to a third of the
# time of compiling is saved. What computes is compiled with -O2, what runs on the cycle's thread with -O3. None of them
# lets the compiler reorder arithmetic, and -ffp-contract=off keeps machines from fusing two operations.
option(PLUMB_PRECOMPILED "Read the headers of other libraries once" ${PROJECT_IS_TOP_LEVEL})
if(PROJECT_IS_TOP_LEVEL AND CMAKE_BUILD_TYPE STREQUAL "Release")
  set(PLUMB_COMPUTES -O2)
  set(PLUMB_READS_AND_PRINTS -O1)
endif()

# plumb_precompiled_header(NAME OPTIMISATION [LIBS...] [HEADERS...]): read only by what is optimised alike.
function(plumb_precompiled_header name optimisation)
  cmake_parse_arguments(arg "" "" "LIBS;HEADERS" ${ARGN})
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${name} PRIVATE plumb_options Eigen3::Eigen fmt::fmt ${arg_LIBS})
  # The physics is computed alike everywhere (Plumb::runtime).
  target_compile_options(${name} PRIVATE -ffp-contract=off ${optimisation})
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numeric> <optional>
    <random> <set> <span> <string> <string_view> <tuple> <variant> <vector>
    <Eigen/Dense> <fmt/format.h> <fmt/ranges.h> ${arg_HEADERS})
endfunction()

if(PLUMB_PRECOMPILED AND PLUMB_OFFLINE AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND NOT CMAKE_CROSSCOMPILING)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  if(NOT EXISTS ${CMAKE_BINARY_DIR}/precompiled.cpp)  # touched only once: all that reads it is compiled after it
    file(WRITE ${CMAKE_BINARY_DIR}/precompiled.cpp "")
  endif()
  plumb_precompiled_header(plumb_precompiled "${PLUMB_COMPUTES}")
  plumb_precompiled_header(plumb_precompiled_prints "${PLUMB_READS_AND_PRINTS}" LIBS nlohmann_json::nlohmann_json
                           HEADERS <nlohmann/json.hpp>)
  if(PLUMB_TESTS)
    find_package(GTest REQUIRED)
    plumb_precompiled_header(plumb_precompiled_tests "${PLUMB_READS_AND_PRINTS}"
                             LIBS nlohmann_json::nlohmann_json GTest::gtest HEADERS <nlohmann/json.hpp> <gtest/gtest.h>)
  endif()
endif()

# plumb_use_precompiled_headers(TARGET [prints|tests]): optimises the target as its kind is, and reads the headers from
# there. Position-independent code as there: an executable may consist of it too.
function(plumb_use_precompiled_headers target)
  if(ARGC GREATER 1)
    target_compile_options(${target} PRIVATE ${PLUMB_READS_AND_PRINTS})
  else()
    target_compile_options(${target} PRIVATE ${PLUMB_COMPUTES})
  endif()
  if(NOT TARGET plumb_precompiled)
    return()
  endif()
  set(header plumb_precompiled)
  if(ARGC GREATER 1)
    set(header plumb_precompiled_${ARGV1})
    target_link_libraries(${target} PRIVATE nlohmann_json::nlohmann_json)
  endif()
  target_link_libraries(${target} PRIVATE Eigen3::Eigen fmt::fmt)
  # With it GCC 12 inlines more of std::string, and sees copies of impossible sizes that are none (GCC bug 105329).
  target_compile_options(${target} PRIVATE
    -fPIC $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow$<SEMICOLON>-Wno-stringop-overread>)
  target_precompile_headers(${target} REUSE_FROM ${header})
endfunction()
