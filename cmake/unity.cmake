# Unity builds: sources of a module are compiled as one, so that the headers that they share are read once.

# The variable of the environment is for a build whose commands are given (scripts/check_printed.py).
option(HOVERCRAFT_UNITY "Compile sources of a module together: a third of the time from nothing, more after a small change" $ENV{HOVERCRAFT_UNITY})
if(HOVERCRAFT_UNITY AND CMAKE_VERSION VERSION_LESS 3.18)
  message(STATUS "HOVERCRAFT_UNITY needs CMake 3.18: each source is compiled by itself")
endif()

# hovercraft_unity(TARGET GROUP SOURCE...): with HOVERCRAFT_UNITY, these sources of the target are compiled together, a dozen at a time: more
# would keep one processor busy while the others have nothing left.
function(hovercraft_unity target group)
  if(NOT HOVERCRAFT_UNITY OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  list(LENGTH ARGN count)
  math(EXPR groups "(${count} + 11) / 12")
  set(index 0)
  foreach(source ${ARGN})
    math(EXPR part "${index} % ${groups}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
    math(EXPR index "${index} + 1")
  endforeach()
endfunction()

# hovercraft_precompile(TARGET LEADER HEADER...): with HOVERCRAFT_UNITY, these headers are read once for all programs of the same LEADER, the
# first of them. For programs of one source, which have nothing to be compiled together with.
function(hovercraft_precompile target leader)
  if(NOT HOVERCRAFT_UNITY OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  if(target STREQUAL leader)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${leader})
  endif()
endfunction()
