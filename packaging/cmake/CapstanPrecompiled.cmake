# The headers that most files include, parsed once for all rooms and once for all tests: a third off a build.
# The preset dev does without, so that a file that forgot to include what it uses is found there.
option(CAPSTAN_PRECOMPILE "Parse the commonest headers once" ON)

set(CAPSTAN_COMMON_HEADERS <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <limits> <map> <memory>
                           <numeric> <optional> <random> <sstream> <string> <string_view> <variant> <vector>
                           <fmt/format.h> <Eigen/Dense>)

# What targets of each KIND reuse: rooms of core/, windows (rooms with Qt), commands (of the command line), tests, and
# window_tests (tests with Qt).
# Libraries and executables differ in how their code may be moved in memory, and a compiler takes no precompiled header
# of the other kind.
if(CAPSTAN_PRECOMPILE)
  file(CONFIGURE OUTPUT precompiled.cpp CONTENT "")
  file(CONFIGURE OUTPUT precompiled_main.cpp CONTENT "int main() {}\n")
  set(kinds room)
  if(CAPSTAN_PROGRAMS)
    list(APPEND kinds window command)
  endif()
  foreach(kind IN LISTS kinds)
    add_library(capstan_precompiled_${kind} STATIC ${PROJECT_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(capstan_precompiled_${kind} PRIVATE capstan_options Eigen3::Eigen fmt::fmt Threads::Threads)
  endforeach()
  target_precompile_headers(capstan_precompiled_room PRIVATE ${CAPSTAN_COMMON_HEADERS})
  if(CAPSTAN_PROGRAMS)
    target_precompile_headers(capstan_precompiled_window PRIVATE ${CAPSTAN_COMMON_HEADERS} <QtWidgets>)
    target_link_libraries(capstan_precompiled_window PRIVATE Qt5::Widgets)
    target_compile_definitions(capstan_precompiled_window PRIVATE QT_NO_EMIT)
    target_precompile_headers(capstan_precompiled_command PRIVATE ${CAPSTAN_COMMON_HEADERS} <CLI/CLI.hpp>
                                                                  <nlohmann/json.hpp>)
    target_link_libraries(capstan_precompiled_command PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json)
  endif()
  if(CAPSTAN_TESTS)
    foreach(kind IN ITEMS test window_test)
      add_executable(capstan_precompiled_${kind} ${PROJECT_BINARY_DIR}/precompiled_main.cpp)
      target_link_libraries(capstan_precompiled_${kind} PRIVATE capstan_options Eigen3::Eigen fmt::fmt Threads::Threads
                                                                GTest::gtest GTest::gmock)
      target_compile_options(capstan_precompiled_${kind} PRIVATE ${CAPSTAN_TEST_OPTIONS})
    endforeach()
    set(test_headers ${CAPSTAN_COMMON_HEADERS} <gtest/gtest.h> <gmock/gmock.h>)
    target_precompile_headers(capstan_precompiled_test PRIVATE ${test_headers})
    target_precompile_headers(capstan_precompiled_window_test PRIVATE ${test_headers} <QtWidgets> <QtTest>)
    target_link_libraries(capstan_precompiled_window_test PRIVATE Qt5::Widgets Qt5::Test)
    target_compile_definitions(capstan_precompiled_window_test PRIVATE QT_NO_EMIT)
  endif()
endif()

#   capstan_precompiled(TARGET room|window|command|test|window_test)
function(capstan_precompiled TARGET KIND)
  if(CAPSTAN_PRECOMPILE)
    target_precompile_headers(${TARGET} REUSE_FROM capstan_precompiled_${KIND})
    target_link_libraries(${TARGET} PRIVATE Eigen3::Eigen fmt::fmt)
    if(KIND STREQUAL window_test)
      target_compile_definitions(${TARGET} PRIVATE QT_NO_EMIT)  # as for all who reuse these headers
    endif()
    # GCC forgets that what was precompiled are the system's headers, and warns of what it inlines from them.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${TARGET} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                               -Wno-stringop-overread)
    endif()
  endif()
endfunction()
