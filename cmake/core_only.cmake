# The core alone and its gtests, for -DHOVERCRAFT_CORE_ONLY=ON: no ROS, no bags, no Python.

find_package(Boost REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(GTest REQUIRED)
find_package(Threads REQUIRED)

include_directories(include)
include(cmake/hovercraft_core.cmake)

# As where there is ROS: the tests reach what the shared library keeps to itself.
add_library(${PROJECT_NAME}_test_core STATIC $<TARGET_OBJECTS:hovercraft_core_objects>)
get_target_property(core_libraries hovercraft_core_objects LINK_LIBRARIES)
target_link_libraries(${PROJECT_NAME}_test_core ${core_libraries})

enable_testing()
foreach(module architecture ${hovercraft_core_modules} determinism)
  file(GLOB test_sources CONFIGURE_DEPENDS test/${module}/test_*.cpp)
  set(target ${PROJECT_NAME}_test_${module})
  add_executable(${target} test/main.cpp ${test_sources})
  target_link_libraries(${target} ${PROJECT_NAME}_test_core GTest::GTest Threads::Threads)
  hovercraft_unity(${target} tests test/main.cpp ${test_sources})
  add_test(NAME ${module} COMMAND ${target} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endforeach()
target_sources(${PROJECT_NAME}_test_determinism PRIVATE test/determinism/recorded_runs.cpp)
