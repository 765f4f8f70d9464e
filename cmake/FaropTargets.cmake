# SPDX-License-Identifier: GPL-3.0-or-later
# Flags that every target of this project shares, and the one way to declare a stage or a test.

add_library(farop_build_flags INTERFACE)
target_compile_features(farop_build_flags INTERFACE cxx_std_20)
# No contraction: the fast and the plain path of one calculation must round alike on every machine.
target_compile_options(farop_build_flags INTERFACE -ffp-contract=off -fno-semantic-interposition -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                                   -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlapping copies in std::string operator+ that are not there (GCC bug 105651).
  target_compile_options(farop_build_flags INTERFACE -Wno-restrict)
endif()
if(FAROP_WARNINGS_AS_ERRORS)
  target_compile_options(farop_build_flags INTERFACE -Werror)
endif()
if(FAROP_SANITIZE)
  # GCC's flow analysis does not see through its own instrumentation.
  target_compile_options(farop_build_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_options(farop_build_flags INTERFACE -fsanitize=${FAROP_SANITIZE} -fno-sanitize-recover=all
                                                     -fno-omit-frame-pointer)
  target_link_options(farop_build_flags INTERFACE -fsanitize=${FAROP_SANITIZE})
endif()

if(CMAKE_UNITY_BUILD)
  # A class of a source that holds another of that source: not in a header, though it looks so here.
  target_compile_options(farop_build_flags INTERFACE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endif()

if(FAROP_BUILD_FUZZERS)
  target_compile_options(farop_build_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(farop_build_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Headers that nearly every file includes are compiled once: without that, reading them is half of a build. Sources name
# what they include all the same (the other presets compile without this: GCC 12 then takes false warnings of its optimiser
# about std::string for ours). Programs and libraries need one each.
if(FAROP_SANITIZE)
  set(farop_empty_source "${PROJECT_BINARY_DIR}/headers/empty.cpp")
  file(GENERATE OUTPUT "${farop_empty_source}" CONTENT "int main() {}\n")
  add_library(farop_stage_headers STATIC "${farop_empty_source}")
  set_target_properties(farop_stage_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(farop_stage_headers PRIVATE fmt::fmt farop_build_flags)
  target_precompile_headers(farop_stage_headers PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <map> <memory> <optional>
                                                        <span> <string> <string_view> <unordered_map> <vector> <fmt/format.h>)
  if(FAROP_BUILD_TESTS)
    add_executable(farop_test_headers "${farop_empty_source}")
    target_link_libraries(farop_test_headers PRIVATE GTest::gtest farop_build_flags)
    target_compile_options(farop_test_headers PRIVATE -O0)
    target_precompile_headers(farop_test_headers PRIVATE <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <map>
                                                         <memory> <random> <sstream> <string> <vector> <gtest/gtest.h>)
  endif()
endif()

# farop_add_stage(NAME SOURCES ... [PUBLIC libs] [PRIVATE libs]): one library per room of src/.
function(farop_add_stage name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(farop_${name} STATIC ${ARG_SOURCES})
  add_library(farop::${name} ALIAS farop_${name})
  # Position-independent: some end up in shared libraries (pictures) as well as in the program.
  set_target_properties(farop_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(farop_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/farop>)
  target_compile_features(farop_${name} PUBLIC cxx_std_20)
  target_link_libraries(farop_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:farop_build_flags>)
  # CGAL brings flags of its own.
  if(FAROP_SANITIZE AND NOT "${ARG_PUBLIC};${ARG_PRIVATE}" MATCHES "CGAL")
    target_precompile_headers(farop_${name} REUSE_FROM farop_stage_headers)
  endif()
endfunction()

# Optimising tests takes longer than they run; the stages that they test are other targets. OPTIMIZED: a test that
# calculates much itself.
if(FAROP_SANITIZE)
  set(farop_test_optimization -O0)
else()
  set(farop_test_optimization $<$<CONFIG:Release>:-O1>)
endif()

# farop_add_test(NAME SOURCES ... LIBS ... [SHARDS n] [OPTIMIZED]): one GoogleTest program, run as n ctest tests that share its cases.
# (A process per case would take longer to load its libraries than to test.)
function(farop_add_test name)
  cmake_parse_arguments(ARG "OPTIMIZED" "SHARDS" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)  # tests share their short names
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE FAROP_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} GTest::gtest_main farop_build_flags)
  if(NOT ARG_OPTIMIZED)
    target_compile_options(${name} PRIVATE ${farop_test_optimization})
    if(FAROP_SANITIZE)
      target_precompile_headers(${name} REUSE_FROM farop_test_headers)
    endif()
  endif()
  if(NOT ARG_SHARDS)
    set(ARG_SHARDS 1)
  endif()
  math(EXPR last "${ARG_SHARDS} - 1")
  foreach(shard RANGE ${last})
    set(test ${name})
    if(ARG_SHARDS GREATER 1)
      set(test ${name}.${shard})
    endif()
    add_test(NAME ${test} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(${test} PROPERTIES TIMEOUT 1200
                         ENVIRONMENT "GTEST_TOTAL_SHARDS=${ARG_SHARDS};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# farop_add_fuzzer(NAME libs...): one libFuzzer program from NAME.cpp. The libraries are compiled with coverage feedback too.
function(farop_add_fuzzer name)
  add_executable(${name} ${name}.cpp)
  target_link_libraries(${name} PRIVATE ${ARGN} farop_build_flags)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
endfunction()
