# The ROS-free core: what it needs, how it is compiled, and the targets hovercraft_core_objects and hovercraft_core. The package
# includes this, and so does test/determinism, which builds the core without ROS; both find Eigen and Boost before.

include(${CMAKE_CURRENT_LIST_DIR}/unity.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/commit.cmake)

option(HOVERCRAFT_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
option(HOVERCRAFT_FUZZ "Programs of libFuzzer for the readers of foreign bytes, with the sanitizers (clang++; scripts/fuzz)" OFF)
option(HOVERCRAFT_WARNINGS_AS_ERRORS "A warning stops the build" OFF)

find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(PNG REQUIRED)
find_package(Threads REQUIRED)
# Qhull, reentrant: Ubuntu 20.04 has neither a package configuration nor a .pc file for it.
find_path(qhull_include_dir libqhull_r/qhull_ra.h REQUIRED)
find_library(qhull_library qhull_r REQUIRED)

# yaml-cpp 0.8 named its target yaml-cpp::yaml-cpp, earlier ones yaml-cpp.
set(yaml_cpp_target yaml-cpp)
if(TARGET yaml-cpp::yaml-cpp)
  set(yaml_cpp_target yaml-cpp::yaml-cpp)
endif()

# What the same bits on every machine need (ARCHITECTURE.md, Determinism): no fused multiply-add, no fast-math, no -march. Eigen's
# matrices start as NaN, so that a number that was never set is seen.
add_compile_options(-ffp-contract=off)
add_compile_definitions(EIGEN_INITIALIZE_MATRICES_BY_NAN)
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast)
if(HOVERCRAFT_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
if(HOVERCRAFT_FUZZ)
  set(HOVERCRAFT_SANITIZE ON)
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()
if(HOVERCRAFT_SANITIZE)
  add_compile_options(-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined,float-cast-overflow)
  add_compile_definitions(HOVERCRAFT_SANITIZE)
  # Undefined behaviour ends in an instruction that AddressSanitizer names the place of, not in a call that describes it: the tests take half
  # the time. vptr has no such instruction.
  if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
    add_compile_options(-fsanitize-trap=undefined,float-cast-overflow -fno-sanitize-trap=vptr)
  endif()
endif()

#catkin_lint: ignore_once external_directory
include_directories(SYSTEM ${EIGEN3_INCLUDE_DIRS} ${qhull_include_dir})

# Every module that knows no ROS.
set(hovercraft_core_modules
  math io pacing geometry body cushion hovercraft collision contact control pilot sensors world lanes scenario sim records analysis)
get_filename_component(hovercraft_root ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
set(hovercraft_core_sources)
foreach(module ${hovercraft_core_modules})
  file(GLOB module_sources CONFIGURE_DEPENDS ${hovercraft_root}/src/${module}/*.cpp)
  set(sources_of_${module} ${module_sources})
  list(APPEND hovercraft_core_sources ${module_sources})
endforeach()
# hovercraft_shared_library(NAME LIBRARY...): NAME_objects, compiled once from the sources in NAME_sources, and of them the library NAME.
# It is always a shared one, and hands out only what HOVERCRAFT_PUBLIC marks (export.h): in a static one the linker would take an
# inline function or an instance of a template from the program's objects, whatever they were compiled with.
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(exported_symbols ${CMAKE_CURRENT_LIST_DIR}/exported_symbols.map)
# Raised by whatever makes a program that was linked with the libraries before wrong: a function or a layout that is another one.
set(hovercraft_soversion 0)
function(hovercraft_shared_library name)
  add_library(${name}_objects OBJECT ${${name}_sources})
  target_link_libraries(${name}_objects ${ARGN})
  if(HOVERCRAFT_SANITIZE)
    # The runtime of the sanitizers, in the program, is hidden from what is shared.
    add_library(${name} STATIC $<TARGET_OBJECTS:${name}_objects>)
  else()
    add_library(${name} SHARED $<TARGET_OBJECTS:${name}_objects>)
    # Of a program the script would hide operator new from the C++ library.
    target_link_options(${name} PRIVATE -Wl,-Bsymbolic-functions -Wl,--version-script=${exported_symbols})
    set_target_properties(${name} PROPERTIES LINK_DEPENDS ${exported_symbols} SOVERSION ${hovercraft_soversion})
  endif()
  target_link_libraries(${name} ${ARGN})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
endfunction()

# A square root that need not set errno is one instruction, and may be taken of several numbers at once: the same numbers for less.
set_source_files_properties(${hovercraft_root}/src/cushion/cushion.cpp PROPERTIES COMPILE_OPTIONS -fno-math-errno)

# The steps of many craft side by side, a source for each instruction set (include/hovercraft_sim/lanes): of no other source's
# options, and without what might fuse or reorder: vectors are written out there. Only where the compiler is for such a processor.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("#if !defined(__x86_64__)\n#error\n#endif\nint main() { return 0; }" HOVERCRAFT_X86_64)
set(lane_options -fno-math-errno -fno-tree-vectorize -fno-tree-slp-vectorize)
set(lane_options_of_avx2 -mavx2)
set(lane_options_of_avx512 -mavx512f)
foreach(set scalar pairs avx2 avx512)
  set(options ${lane_options})
  if(HOVERCRAFT_X86_64)
    list(APPEND options ${lane_options_of_${set}})
  endif()
  if(HOVERCRAFT_FUZZ)
    list(APPEND options -fno-sanitize=fuzzer-no-link)  # no fuzzer comes here
  endif()
  set_source_files_properties(${hovercraft_root}/src/lanes/advance_${set}.cpp PROPERTIES COMPILE_OPTIONS "${options}")
endforeach()
# It takes packs of eight without the registers for them; whatever takes one is inlined, so it does not matter how one is handed over.
set_source_files_properties(${hovercraft_root}/test/lanes/test_lane_advance.cpp PROPERTIES COMPILE_OPTIONS -Wno-psabi)

set(hovercraft_commit_source ${CMAKE_CURRENT_BINARY_DIR}/commit.cpp)
set_source_files_properties(${hovercraft_commit_source} PROPERTIES GENERATED TRUE)
list(APPEND hovercraft_core_sources ${hovercraft_commit_source})
hovercraft_commit(hovercraft_commit ${CMAKE_CURRENT_LIST_DIR}/commit.cpp.in ${hovercraft_commit_source})
hovercraft_shared_library(hovercraft_core ${yaml_cpp_target} fmt::fmt PNG::PNG Threads::Threads ${qhull_library})
add_dependencies(hovercraft_core_objects hovercraft_commit)
foreach(module ${hovercraft_core_modules})
  hovercraft_unity(hovercraft_core_objects ${module} ${sources_of_${module}})
endforeach()
