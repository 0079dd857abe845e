# SPDX-License-Identifier: Apache-2.0
# Several files of a room are compiled as one, so that what they all include is read and instantiated once: that is most
# of the time of compiling. Names in anonymous namespaces must therefore differ within a room.
option(PLUMB_UNITY "Compile the offline half and the programs several files at a time" ${PROJECT_IS_TOP_LEVEL})
set(PLUMB_UNITY_BATCH "" CACHE STRING "How many files are compiled as one; 0 for a whole room; empty as each room says")

# plumb_unity(TARGET FILES): so many files at a time, unless PLUMB_UNITY_BATCH says otherwise. No step shall take longer
# than 15 s or a GB: rooms that compute, where each file instantiates much, take few.
function(plumb_unity target batch)
  if(PLUMB_UNITY)
    if(NOT PLUMB_UNITY_BATCH STREQUAL "")
      set(batch ${PLUMB_UNITY_BATCH})
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
    # It takes a type of an anonymous namespace for one of a header when its file is included.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
