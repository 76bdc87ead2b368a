# gtest programs, each run as one test or as several. The target `gtests` builds them all, and what they run.

# hovercraft_add_gtest(MODULE SOURCE...): the program hovercraft_sim_test_MODULE, run in the root of the checkout. With parts_of_MODULE set,
# each of as many runs does its share of the tests (gtest's shards), beside the others where ctest may.
function(hovercraft_add_gtest module)
  set(target ${PROJECT_NAME}_test_${module})
  if(parts_of_${module})
    catkin_add_executable_with_gtest(${target} ${ARGN} EXCLUDE_FROM_ALL)
  else()
    catkin_add_gtest(${target} ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  endif()
  if(NOT TARGET ${target})
    return()
  endif()
  target_link_libraries(${target} ${PROJECT_NAME}_test_core)
  # What is tested is optimised as ever; the tests themselves take up to half of the time to compile.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(HOVERCRAFT_FUZZ)
    target_compile_options(${target} PRIVATE -fno-sanitize=fuzzer-no-link)  # what the fuzzers learn from is in the libraries
  endif()
  hovercraft_unity(${target} tests ${ARGN})
  if(NOT TARGET gtests)
    add_custom_target(gtests)
  endif()
  add_dependencies(gtests ${target})
  if(parts_of_${module})
    add_dependencies(tests ${target})
    math(EXPR last "${parts_of_${module}} - 1")
    foreach(part RANGE ${last})
      set(result gtest-${target}-${part}.xml)
      catkin_run_tests_target("gtest" ${target}-${part} ${result}
        COMMAND "GTEST_TOTAL_SHARDS=${parts_of_${module}} GTEST_SHARD_INDEX=${part} $<TARGET_FILE:${target}> --gtest_output=xml:${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${result}"
        DEPENDENCIES ${target} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    endforeach()
  endif()
endfunction()

# hovercraft_order_tests(): gtests may run beside each other, those in parts first; a rostest shares the machine's time with nothing else.
function(hovercraft_order_tests)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach(test ${tests})
    if(NOT test MATCHES "_gtest_")
      set_tests_properties(${test} PROPERTIES RUN_SERIAL TRUE)
    elseif(test MATCHES "-[0-9]+$")
      set_tests_properties(${test} PROPERTIES COST 1000)
    endif()
  endforeach()
endfunction()
