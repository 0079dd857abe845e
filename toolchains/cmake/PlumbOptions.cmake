# SPDX-License-Identifier: Apache-2.0
# What every target of ours is compiled with. Linked privately, so nothing of it reaches those who embed us.
add_library(plumb_options INTERFACE)
if(PLUMB_STRICT)
  target_compile_options(plumb_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                 -Wnon-virtual-dtor -Wold-style-cast -Werror)
  # GCC 12 sees overlapping copies in std::string that are none (GCC bug 105651), and, with AVX, four-wide loads from
  # Eigen's three-vectors in a loop that never runs for them.
  target_compile_options(plumb_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict$<SEMICOLON>-Wno-array-bounds>)
  if(PLUMB_SANITIZE)
    # Under sanitizers it also takes the state machine of std::regex for uninitialised (GCC bug 105562).
    target_compile_options(plumb_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  endif()
endif()
# The distribution's Ceres and KDL align Eigen's heap to 16 bytes; code compiled for AVX would expect 32 of them. And Eigen
# computes one number at a time, in both halves alike: the linker keeps one copy of an Eigen function that both use, and
# sums of two kinds would make the last digits of a result depend on which copy that was.
target_compile_definitions(plumb_options INTERFACE EIGEN_MAX_ALIGN_BYTES=16 EIGEN_DONT_VECTORIZE)
if(PLUMB_SANITIZE)
  # Without the three checks of every access, which double the time a build takes; the half that is embedded, where
  # memory is laid out by hand, asks for them (plumb_embedded_options).
  add_compile_options(-fsanitize=${PLUMB_SANITIZE} -fno-sanitize=null,alignment,object-size,vptr
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${PLUMB_SANITIZE})
endif()
if(PLUMB_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
if(PLUMB_COVERAGE)
  add_compile_options(--coverage)
  add_link_options(--coverage)
endif()

# For runtime, model_format and drivers.
add_library(plumb_embedded_options INTERFACE)
target_link_libraries(plumb_embedded_options INTERFACE plumb_options)
if(PLUMB_SANITIZE MATCHES "undefined")
  target_compile_options(plumb_embedded_options INTERFACE -fsanitize=null,alignment,object-size)
endif()
