# Catch2 2.13 and 3 behind one target, and one function that makes a labelled test program.

find_package(Catch2 3 QUIET CONFIG)
if(Catch2_FOUND)
  add_library(koksma_catch INTERFACE)
  target_link_libraries(koksma_catch INTERFACE Catch2::Catch2WithMain)
else()
  find_package(Catch2 2.13 REQUIRED CONFIG)
  file(WRITE ${PROJECT_BINARY_DIR}/catch_main.cpp "#define CATCH_CONFIG_MAIN\n#include <catch2/catch.hpp>\n")
  add_library(koksma_catch STATIC ${PROJECT_BINARY_DIR}/catch_main.cpp)
  target_link_libraries(koksma_catch PUBLIC Catch2::Catch2)
  target_compile_features(koksma_catch PUBLIC cxx_std_20)
endif()
target_include_directories(koksma_catch INTERFACE ${PROJECT_SOURCE_DIR}/tests)
include(Catch)

# koksma_add_test(<name> LABELS <label>... SOURCES <file>... [SAMPLERS ALL | <name>...] [LINK <target>...] [PROPERTIES <key> <value>...])
#   One program, one CTest test per TEST_CASE, named "<name>: <test case>".
function(koksma_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LABELS;SOURCES;SAMPLERS;LINK;PROPERTIES")
  add_executable(test_${name} ${arg_SOURCES})
  koksma_target(test_${name})
  target_link_libraries(test_${name} PRIVATE koksma_catch koksma::sampling ${arg_LINK})
  target_compile_definitions(test_${name} PRIVATE KOKSMA_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(arg_SAMPLERS)
    koksma_link_samplers(test_${name} ${arg_SAMPLERS})
  endif()
  koksma_discover_tests(${name} PREFIX "${name}: " LABELS ${arg_LABELS} PROPERTIES ${arg_PROPERTIES})
endfunction()

# koksma_discover_tests(<name> PREFIX <prefix> LABELS <label>... [SPEC <Catch2 test spec>] [PROPERTIES <key> <value>...])
#   The test cases of a program as CTest tests; once more for those of a spec that are to run in another environment.
function(koksma_discover_tests name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PREFIX;SPEC" "LABELS;PROPERTIES")
  # Catch's script cannot carry a list of labels; ctest -L and -LE search within a label, so "hard-slow" is found by both words.
  list(JOIN arg_LABELS "-" labels)
  # A semicolon in a test case's name makes two names of it, which nothing matches: that passes, unless it is said to fail.
  catch_discover_tests(test_${name} TEST_SPEC ${arg_SPEC}
                       TEST_PREFIX "${arg_PREFIX}" DISCOVERY_MODE PRE_TEST
                       PROPERTIES LABELS "${labels}" TIMEOUT 600 SKIP_REGULAR_EXPRESSION "SKIPPED: " FAIL_REGULAR_EXPRESSION "No tests ran"
                                  ${arg_PROPERTIES})
endfunction()
