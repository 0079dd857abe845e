# SPDX-License-Identifier: Apache-2.0
# Run by CPack when the components are installed into its temporary folders and no package is written yet. Adds to each
# what Debian's policy wants beside the files themselves, and puts what Debian has elsewhere into its place.
set(ENV{LC_ALL} C)

function(packed file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(finish component package)
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
  if(NOT IS_DIRECTORY ${root})
    message(FATAL_ERROR "package ${package}: component ${component} is not in ${CPACK_TEMPORARY_INSTALL_DIRECTORY}")
  endif()
  set(share ${root}/usr/share)
  set(doc ${share}/doc/${package})
  file(MAKE_DIRECTORY ${doc})
  file(COPY_FILE ${CPACK_PLUMB_DEBIAN}/copyright ${doc}/copyright)
  file(COPY_FILE ${CPACK_PLUMB_DEBIAN}/../../CHANGELOG.md ${doc}/changelog)
  configure_file(${CPACK_PLUMB_DEBIAN}/changelog.in ${doc}/changelog.Debian @ONLY)
  packed(${doc}/changelog)
  packed(${doc}/changelog.Debian)
  if(EXISTS ${CPACK_PLUMB_DEBIAN}/${package}.lintian-overrides)
    file(MAKE_DIRECTORY ${share}/lintian/overrides)
    file(COPY_FILE ${CPACK_PLUMB_DEBIAN}/${package}.lintian-overrides ${share}/lintian/overrides/${package})
  endif()
  file(GLOB pages ${share}/man/man*/*.[1-9])
  foreach(page ${pages})
    packed(${page})
  endforeach()
  # Debian's zsh does not look into site-functions.
  if(IS_DIRECTORY ${share}/zsh/site-functions)
    file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
  endif()
  # A static library keeps the names that a linker needs, and nothing for a debugger.
  file(GLOB_RECURSE libraries ${root}/*.a)
  foreach(library ${libraries})
    execute_process(COMMAND ${CPACK_PLUMB_STRIP} --strip-debug --remove-section=.comment --remove-section=.note
                            --enable-deterministic-archives ${library} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  file(GLOB_RECURSE variants ${root}/usr/libexec/plumb/*)
  foreach(program ${variants})
    execute_process(COMMAND ${CPACK_PLUMB_STRIP} ${program} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  execute_process(COMMAND chmod -R u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)
  # One date for every file, so that the same sources give the same packages.
  if(DEFINED ENV{SOURCE_DATE_EPOCH})
    execute_process(COMMAND find ${root} -exec touch --no-dereference --date=@$ENV{SOURCE_DATE_EPOCH} {} +
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()
endfunction()

set(release ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(contact ${CPACK_PACKAGE_CONTACT})
set(date ${CPACK_PLUMB_DATE})
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  finish(${component} ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()
