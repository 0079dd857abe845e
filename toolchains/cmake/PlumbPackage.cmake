# SPDX-License-Identifier: Apache-2.0
# Debian packages, made by scripts/package from the install components: plumb, plumb-rt, libplumb-dev,
# libplumb0 and python3-plumb. What a package
# has beyond the installed files (copyright, change log, compressed manual pages) is added by package_files.cmake.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(PLUMB_MAINTAINER "Plumb maintainers <plumb@packages.invalid>" CACHE STRING "Maintainer of the Debian packages")
set(debian ${PROJECT_SOURCE_DIR}/toolchains/debian)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME plumb)
set(CPACK_PACKAGE_CONTACT ${PLUMB_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
# Whatever the umask of who packages.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/toolchains/cmake/package_files.cmake)
set(CPACK_PLUMB_DEBIAN ${debian})
set(CPACK_PLUMB_STRIP ${CMAKE_STRIP})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL plumb-rt dev lib)
if(TARGET plumb)
  list(APPEND CPACK_COMPONENTS_ALL plumb python)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
if(CMAKE_CROSSCOMPILING)
  # Where dpkg-shlibdeps looks; which package each library is from, toolchains/sysroot has written down.
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${cross_arch})
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${cross_root}/usr/lib/${cross_triple} ${cross_root}/lib/${cross_triple})
endif()

set(CPACK_DEBIAN_PLUMB_PACKAGE_NAME plumb)
set(CPACK_DEBIAN_PLUMB_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PLUMB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PLUMB_PACKAGE_RECOMMENDS plumb-rt)
set(CPACK_DEBIAN_PLUMB_PACKAGE_SUGGESTS "chromium")
set(CPACK_COMPONENT_PLUMB_DESCRIPTION "calibration of robot arms, with the workbench
Plumb reads joint angles and laser-tracker positions, calibrates the arm, finds
which physical effect is missing, shows with held-out poses how good the result
is, and compiles everything into one small model file.

This package holds the programs plumb (with the workbench in the browser) and
plumb-twin, a simulated controller, arm and tracker for trying everything
without a robot.")

set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_NAME plumb-rt)
set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_DEPENDS
    "systemd | systemd-standalone-sysusers, systemd | systemd-standalone-tmpfiles")
set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_RECOMMENDS "iproute2, nftables, udev")
set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_SUGGESTS "can-utils, prometheus")
set(CPACK_DEBIAN_PLUMB-RT_PACKAGE_CONTROL_EXTRA ${debian}/postinst ${debian}/prerm ${debian}/postrm)
set(CPACK_COMPONENT_PLUMB-RT_DESCRIPTION "real-time correction of robot targets
plumb-rt takes desired targets of a robot arm from CAN or Modbus and answers
each with the corrected one, from a model that plumb has compiled. It is not a
safety function.

This package holds the program with its systemd unit, udev rules, system user
and folders.")
if(PLUMB_RT_V3)
  string(APPEND CPACK_COMPONENT_PLUMB-RT_DESCRIPTION " On processors with AVX2 it replaces itself by code
compiled for x86-64-v3, which gives the same bits.")
endif()

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libplumb-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libmodbus-dev")
if(NOT PLUMB_MODBUS)
  set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "cmake, g++")
set(CPACK_COMPONENT_DEV_DESCRIPTION "correction of robot targets in your own controller
Headers and static libraries of Plumb's hard-real-time cycle for C++ and C,
of the reader of model files, and of the drivers for CAN and Modbus, with a
configuration for CMake and examples.")

set(CPACK_DEBIAN_LIB_PACKAGE_NAME libplumb0)
set(CPACK_DEBIAN_LIB_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIB_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIB_PACKAGE_CONTROL_EXTRA ${debian}/libplumb0/shlibs ${debian}/libplumb0/triggers)
set(CPACK_COMPONENT_LIB_DESCRIPTION "correction of robot targets, as a shared library
The C interface of Plumb (plumb.h of libplumb-dev) for programs that load it
while they run, such as Python: it loads a compiled model, predicts where the
arm truly is and corrects targets, one in a cycle or lists of them.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-plumb)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.9), python3-numpy, libplumb0")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS plumb)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${debian}/python3-plumb/postinst ${debian}/python3-plumb/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "calibration of robot arms, from Python
The package plumb runs the verbs of the program plumb, with typed results, and
evaluates compiled models on numpy arrays.")
include(CPack)
