# The core as a package of Python, hovercraft_core (doc/python.md): two extension modules, _core without ROS and _bags, and what is Python.

set(HOVERCRAFT_PYTHON AUTO CACHE STRING "Build Python's package hovercraft_core: ON, OFF, or AUTO where pybind11, numpy and Python's headers are there")
set_property(CACHE HOVERCRAFT_PYTHON PROPERTY STRINGS AUTO ON OFF)

# Sets python_found to whether the package can be built; with ON what is missing is an error. Not in a function: pybind11 of Debian 13 reads
# later on what it has set here.
set(python_found OFF)
if(HOVERCRAFT_PYTHON)
  set(demand QUIET)
  if(NOT HOVERCRAFT_PYTHON STREQUAL AUTO)
    set(demand REQUIRED)
  endif()
  # Not Python3: pybind11 takes this one where it is there, and catkin of Debian 13 has found its interpreter alone.
  find_package(Python 3 ${demand} COMPONENTS Interpreter Development)
  find_package(pybind11 2.6 ${demand} CONFIG)
  if(Python_Development_FOUND AND pybind11_FOUND)
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import numpy" RESULT_VARIABLE without_numpy OUTPUT_QUIET ERROR_QUIET)
    if(NOT without_numpy)
      set(python_found ON)
    elseif(HOVERCRAFT_PYTHON STREQUAL AUTO)
      message(STATUS "Python's package hovercraft_core is not built: python3-numpy is not there")
    else()
      message(FATAL_ERROR "HOVERCRAFT_PYTHON: python3-numpy is not there")
    endif()
  else()
    message(STATUS "Python's package hovercraft_core is not built: pybind11-dev and python3-dev are not there")
  endif()
endif()

# hovercraft_extension(NAME LIBRARY SOURCE...): the extension module hovercraft_core.NAME, linked with the library. It finds the library from
# where it lies, whatever the environment.
function(hovercraft_extension name library)
  set(target ${PROJECT_NAME}_python${name})
  pybind11_add_module(${target} MODULE NO_EXTRAS ${ARGN})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${python_package}
    INSTALL_RPATH "$ORIGIN/../../.." BUILD_RPATH "$ORIGIN/../../..")
  target_link_libraries(${target} PRIVATE ${library})
  install(TARGETS ${target} LIBRARY DESTINATION ${CATKIN_GLOBAL_PYTHON_DESTINATION}/hovercraft_core)
  list(APPEND extensions ${target})
  set(extensions ${extensions} PARENT_SCOPE)
endfunction()

if(python_found)
  set(python_package ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION}/hovercraft_core)
  set(extensions)
  file(MAKE_DIRECTORY ${python_package}/studies)
  set(shared ${PROJECT_SOURCE_DIR}/src/python/command_list.cpp ${PROJECT_SOURCE_DIR}/src/python/rows.cpp)
  hovercraft_extension(_core hovercraft_core ${shared} ${PROJECT_SOURCE_DIR}/src/python/core_module.cpp ${PROJECT_SOURCE_DIR}/src/python/held_scenario.cpp
    ${PROJECT_SOURCE_DIR}/src/python/recorder.cpp ${PROJECT_SOURCE_DIR}/src/python/stepped_batch.cpp ${PROJECT_SOURCE_DIR}/src/python/stepped_simulation.cpp ${PROJECT_SOURCE_DIR}/src/python/studies.cpp)
  hovercraft_extension(_bags hovercraft_ros ${shared} ${PROJECT_SOURCE_DIR}/src/python/bags_module.cpp)
  file(GLOB python_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/python/hovercraft_core/*.py ${PROJECT_SOURCE_DIR}/python/hovercraft_core/*.pyi
    ${PROJECT_SOURCE_DIR}/python/hovercraft_core/py.typed)
  foreach(file ${python_files})
    configure_file(${file} ${python_package} COPYONLY)
  endforeach()
  install(FILES ${python_files} DESTINATION ${CATKIN_GLOBAL_PYTHON_DESTINATION}/hovercraft_core)
  file(GLOB study_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/python/hovercraft_core/studies/*.py)
  foreach(file ${study_files})
    configure_file(${file} ${python_package}/studies COPYONLY)
  endforeach()
  install(FILES ${study_files} DESTINATION ${CATKIN_GLOBAL_PYTHON_DESTINATION}/hovercraft_core/studies)
  add_custom_target(${PROJECT_NAME}_python DEPENDS ${extensions})
endif()
