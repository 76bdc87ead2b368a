# The front end of pages (web/dist, built by npm and committed), as a source of the library: a program that makes a page needs no other file.

# hovercraft_front_end(VARIABLE): writes the source, sets the variable to its path.
function(hovercraft_front_end variable)
  set(made ${PROJECT_BINARY_DIR}/front_end.cpp)
  set(text "#include \"hovercraft_sim/report/front_end.h\"\n\nnamespace hovercraft_ros {\n")
  foreach(part "Page;report.html" "LivePage;live.html" "Script;report.js")
    list(GET part 0 name)
    list(GET part 1 file)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/web/dist/${file})
    # As hexadecimal digits: CMake gives a meaning to brackets and semicolons of a text.
    file(READ ${PROJECT_SOURCE_DIR}/web/dist/${file} digits HEX)
    string(LENGTH "${digits}" length)
    math(EXPR bytes "${length} / 2")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" digits "${digits}")
    # Pieces of 64 kB of text, as one line would stop some compilers.
    string(LENGTH "${digits}" length)
    set(literal "")
    set(at 0)
    while(at LESS length)
      string(SUBSTRING "${digits}" ${at} 65536 piece)
      string(APPEND literal "\n    \"${piece}\"")
      math(EXPR at "${at} + 65536")
    endwhile()
    string(APPEND text
      "\nstd::string_view frontEnd${name}() {\n  static const char text[] =${literal};\n  return {text, ${bytes}};\n}\n")
  endforeach()
  string(APPEND text "\n}  // namespace hovercraft_ros\n")
  file(GENERATE OUTPUT ${made} CONTENT "${text}")
  set(${variable} ${made} PARENT_SCOPE)
endfunction()
