# SPDX-License-Identifier: Apache-2.0
# Manual pages and shell completions: each program prints its own, from the tables that its help comes from. The target
# "man" writes them into the folder share of the build folder, with the page of the JSON schemas. Where the programs cannot be run, there are none.

# plumb_pages(PROGRAM COMPONENT): the pages of one program, and where they are installed.
function(plumb_pages program component)
  set(share ${PROJECT_BINARY_DIR}/share)
  set(man ${share}/man/man1/${program}.1)
  set(bash ${share}/bash-completion/completions/${program})
  set(zsh ${share}/zsh/site-functions/_${program})
  set(fish ${share}/fish/vendor_completions.d/${program}.fish)
  foreach(page ${man} ${bash} ${zsh} ${fish})
    cmake_path(GET page PARENT_PATH folder)
    file(MAKE_DIRECTORY ${folder})
  endforeach()
  add_custom_command(OUTPUT ${man} ${bash} ${zsh} ${fish}
    COMMAND ${program} --man > ${man}
    COMMAND ${program} --completion bash > ${bash}
    COMMAND ${program} --completion zsh > ${zsh}
    COMMAND ${program} --completion fish > ${fish}
    DEPENDS ${program} COMMENT "Manual page and completions of ${program}" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY plumb_pages ${man} ${bash} ${zsh} ${fish})
  # Optional: a build of some targets only can be installed too.
  install(FILES ${man} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component} OPTIONAL)
  foreach(page ${bash} ${zsh} ${fish})
    cmake_path(GET page PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${share})
    install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder} COMPONENT ${component} OPTIONAL)
  endforeach()
endfunction()

# plumb_json_page(COMPONENT): what the verbs print with --json, in tables, and the schemas that they are made of.
function(plumb_json_page component)
  find_program(PLUMB_PAGE_PYTHON python3)
  if(NOT PLUMB_PAGE_PYTHON)
    return()
  endif()
  set(page ${PROJECT_BINARY_DIR}/share/doc/plumb/json.md)
  cmake_path(GET page PARENT_PATH folder)
  file(MAKE_DIRECTORY ${folder})
  file(GLOB schemas CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/schemas/*)
  add_custom_command(OUTPUT ${page} COMMAND ${PROJECT_SOURCE_DIR}/scripts/json-page > ${page}
                     DEPENDS ${schemas} ${PROJECT_SOURCE_DIR}/tests/pages/json_page.py COMMENT "Page of the JSON schemas" VERBATIM)
  set_property(GLOBAL APPEND PROPERTY plumb_pages ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/plumb COMPONENT ${component} OPTIONAL)
  install(FILES ${schemas} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/plumb/schemas COMPONENT ${component})
endfunction()

# A cross build runs its programs in the emulator of its toolchain file, if that names one.
if(PROJECT_IS_TOP_LEVEL AND NOT PLUMB_SANITIZE AND (CMAKE_CROSSCOMPILING_EMULATOR OR NOT CMAKE_CROSSCOMPILING))
  foreach(program plumb plumb-twin)
    if(TARGET ${program})
      plumb_pages(${program} plumb)
    endif()
  endforeach()
  if(TARGET plumb)
    plumb_json_page(plumb)
  endif()
  if(TARGET plumb-rt)
    plumb_pages(plumb-rt plumb-rt)
  endif()
  get_property(pages GLOBAL PROPERTY plumb_pages)
  if(PLUMB_NUMERIC_TESTS)
    add_custom_target(man ALL DEPENDS ${pages})
  else()
    add_custom_target(man DEPENDS ${pages})  # the offline half is built on demand only
  endif()
endif()
