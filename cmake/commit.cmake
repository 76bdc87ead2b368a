# The version of the package, and the commit that it was built from, for programs to name (--version): a source of the core, and a module of
# Python's package hovercraft_sim. They are written anew, at each build, when the commit has changed.

if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(HOVERCRAFT_COMMIT "" CACHE STRING "The commit that programs name with --version; empty: as git says at each build")
  set(hovercraft_commit_script ${CMAKE_CURRENT_LIST_FILE})

  # hovercraft_commit(TARGET TEMPLATE FILE): the target, on which others depend, makes the file of the template.
  function(hovercraft_commit target template file)
    add_custom_target(${target} BYPRODUCTS ${file} VERBATIM
      COMMAND ${CMAKE_COMMAND} "-DHOVERCRAFT_COMMIT=${HOVERCRAFT_COMMIT}" -DTEMPLATE=${template} -DFILE=${file} -P ${hovercraft_commit_script})
  endfunction()
  return()
endif()

# A script from here on.
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
set(commit "${HOVERCRAFT_COMMIT}")
if(NOT commit)
  # A checkout of its own: in the repository of somebody's workspace git would name another commit. -dirty: with changes.
  execute_process(COMMAND git rev-parse --show-prefix WORKING_DIRECTORY ${root} RESULT_VARIABLE result OUTPUT_VARIABLE prefix ERROR_QUIET
    OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(result EQUAL 0 AND prefix STREQUAL "")
    execute_process(COMMAND ${CMAKE_COMMAND} -E env GIT_OPTIONAL_LOCKS=0 git describe --always --dirty --abbrev=12 --exclude=*
      WORKING_DIRECTORY ${root} OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
endif()
if(NOT commit)
  set(commit "unknown")
endif()
if(NOT commit MATCHES "^[0-9A-Za-z.+~-]+$")
  message(FATAL_ERROR "HOVERCRAFT_COMMIT = ${commit}: must be letters, digits and . + ~ -")
endif()
file(STRINGS ${root}/package.xml version REGEX "<version>")
string(REGEX REPLACE ".*<version>(.*)</version>.*" "\\1" version "${version}")
file(STRINGS ${root}/include/hovercraft_sim/scenario/version.h physics REGEX "kPhysicsVersion =")
string(REGEX REPLACE ".*= ([0-9]+).*" "\\1" physics "${physics}")
configure_file(${TEMPLATE} ${FILE} @ONLY)
