# SPDX-License-Identifier: Apache-2.0
# Install and export: find_package(Plumb) gives Plumb::format, Plumb::runtime, Plumb::robot, Plumb::c
# and, on Linux, Plumb::drivers. Five components, each of which is a Debian package (PlumbPackage.cmake): plumb (the
# offline half with the twin), plumb-rt (the daemon and what the system needs for it), dev (what is linked), lib (the C
# interface as a shared library) and python (the package that uses both).
include(CMakePackageConfigHelpers)

# plumb_needs(COMPONENT TARGET...): the installation of a component ends with what to build, if a target of it is not.
function(plumb_needs component)
  install(CODE "set(plumb_missing)" COMPONENT ${component})
  foreach(target ${ARGN})
    if(TARGET ${target})
      install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
  list(APPEND plumb_missing ${target})
endif()" COMPONENT ${component})
    endif()
  endforeach()
  install(CODE "if(plumb_missing)
  string(REPLACE \";\" \" \" plumb_missing \"\${plumb_missing}\")
  message(FATAL_ERROR \"component ${component} is not built whole. Build it first:\\n  cmake --build ${PROJECT_BINARY_DIR} --target \${plumb_missing}\\nor install another one alone: --component plumb|plumb-rt|dev|lib|python\")
endif()" COMPONENT ${component})
endfunction()
plumb_needs(dev plumb_format plumb_runtime plumb_robot plumb_c plumb_drivers)
plumb_needs(plumb plumb plumb-twin)
plumb_needs(plumb-rt plumb-rt)
plumb_needs(lib plumb_shared)

set(plumb_package ${CMAKE_INSTALL_LIBDIR}/cmake/Plumb)
install(TARGETS plumb_format plumb_runtime plumb_robot plumb_c EXPORT PlumbTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
install(DIRECTORY model_format/include/ runtime/include/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
install(EXPORT PlumbTargets NAMESPACE Plumb:: DESTINATION ${plumb_package} COMPONENT dev)
configure_package_config_file(toolchains/cmake/PlumbConfig.cmake.in PlumbConfig.cmake
                              INSTALL_DESTINATION ${plumb_package})
write_basic_package_version_file(PlumbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PlumbConfig.cmake ${PROJECT_BINARY_DIR}/PlumbConfigVersion.cmake
        DESTINATION ${plumb_package} COMPONENT dev)
foreach(program plumb plumb-twin)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT plumb)
  endif()
endforeach()
if(TARGET plumb-rt)
  install(TARGETS plumb-rt RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT plumb-rt)
endif()
if(TARGET plumb_drivers)
  install(TARGETS plumb_drivers EXPORT PlumbTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  install(DIRECTORY drivers/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
endif()

if(TARGET plumb_shared)
  install(TARGETS plumb_shared LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} NAMELINK_SKIP COMPONENT lib)
endif()
if(TARGET plumb AND PROJECT_IS_TOP_LEVEL)
  set(PLUMB_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Where Python looks for packages, below the prefix")
  install(DIRECTORY offline/python/plumb DESTINATION ${PLUMB_PYTHON_DIR} COMPONENT python PATTERN __pycache__ EXCLUDE)
  install(FILES examples/08_from_python.py DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-plumb/examples COMPONENT python)
endif()

# The examples, with a project of their own and the model that two of them read.
if(PROJECT_IS_TOP_LEVEL)
  set(plumb_examples ${CMAKE_INSTALL_DATADIR}/doc/libplumb-dev/examples)
  file(GLOB examples CONFIGURE_DEPENDS examples/*.cpp examples/*.c examples/*.hpp)
  install(FILES ${examples} tests/format/golden/planar_2r.plumb DESTINATION ${plumb_examples} COMPONENT dev)
  install(FILES toolchains/cmake/installed_examples.cmake DESTINATION ${plumb_examples} RENAME CMakeLists.txt COMPONENT dev)
endif()
