# SPDX-License-Identifier: Apache-2.0
# Several files of a room are compiled as one, so that what they all include is read and instantiated once: that is most
# of the time of compiling. Names in anonymous namespaces must therefore differ within a room.
option(PLUMB_UNITY "Compile the offline half and the programs several files at a time" ${PROJECT_IS_TOP_LEVEL})
set(PLUMB_UNITY_BATCH 8 CACHE STRING "How many files are compiled as one; 0 for a whole room")

function(plumb_unity target)
  if(PLUMB_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${PLUMB_UNITY_BATCH})
    # It takes a type of an anonymous namespace for one of a header when its file is included.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
