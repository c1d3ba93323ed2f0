# Compiles the sources of a target COUNT at a time: most of a file is headers and templates that its neighbours use, too.
# Names in anonymous namespaces have to differ within a target. The preset dev compiles each file alone.
function(capstan_compile_together TARGET COUNT)
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ${CAPSTAN_PRECOMPILE} UNITY_BUILD_BATCH_SIZE ${COUNT})
endfunction()

# A room of core/ or widgets/: one folder, one static library, one layer.
#   capstan_room(NAME robot SOURCES … [ALONE …] LINKS capstan::base PRIVATE_LINKS …)
# What the room may include is what it LINKS; tests/architecture holds it to that.
# SOURCES are compiled six at a time, files of ALONE by themselves.
function(capstan_room)
  cmake_parse_arguments(ROOM "" "NAME" "SOURCES;ALONE;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(capstan_${ROOM_NAME} STATIC ${ROOM_SOURCES} ${ROOM_ALONE})
  capstan_compile_together(capstan_${ROOM_NAME} 6)
  set_source_files_properties(${ROOM_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_library(capstan::${ROOM_NAME} ALIAS capstan_${ROOM_NAME})
  target_link_libraries(capstan_${ROOM_NAME} PUBLIC ${ROOM_LINKS} PRIVATE capstan_options ${ROOM_PRIVATE_LINKS})
  target_include_directories(capstan_${ROOM_NAME} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/capstan>)
  target_compile_features(capstan_${ROOM_NAME} PUBLIC cxx_std_20)
  # A function is a section of its own: of files that are compiled together, a program takes what it calls.
  target_compile_options(capstan_${ROOM_NAME} PRIVATE -ffunction-sections -fdata-sections)
  set_target_properties(capstan_${ROOM_NAME} PROPERTIES EXPORT_NAME ${ROOM_NAME})
  set_property(GLOBAL APPEND PROPERTY CAPSTAN_ROOMS capstan_${ROOM_NAME})
  if(Qt5::Widgets IN_LIST ROOM_LINKS)
    capstan_precompiled(capstan_${ROOM_NAME} window)
  else()
    capstan_precompiled(capstan_${ROOM_NAME} room)
  endif()
  if(CAPSTAN_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC takes files that are compiled together for headers, and warns of their classes with members of types in
    # anonymous namespaces.
    target_compile_options(capstan_${ROOM_NAME} PRIVATE -Wno-subobject-linkage)
  endif()
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "/widgets/(panels|shell)")  # forms and buttons compute nothing themselves
    target_compile_options(capstan_${ROOM_NAME} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# A GoogleTest executable, its cases registered with CTest one by one. With SUITES each suite is one test, for many
# short cases: to start a program that links OpenCV takes a tenth of a second. With WHOLE all of it is one test,
# where its cases share what takes long to make.
# SOURCES are compiled five at a time, files of ALONE by themselves, where their names are those of a neighbour.
#   capstan_test(NAME robot_test SOURCES … [ALONE …] LINKS capstan::robot [TIMEOUT seconds] [SUITES|WHOLE])
function(capstan_test)
  cmake_parse_arguments(TEST "SUITES;WHOLE" "NAME;TIMEOUT" "SOURCES;ALONE;LINKS" ${ARGN})
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 240)  # on a loaded machine with two cores
    if(TEST_SUITES)
      set(TEST_TIMEOUT 600)
    endif()
  endif()
  add_executable(${TEST_NAME} ${TEST_SOURCES} ${TEST_ALONE})
  target_link_libraries(${TEST_NAME} PRIVATE ${TEST_LINKS} capstan_test_folders capstan_options GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_options(${TEST_NAME} PRIVATE ${CAPSTAN_TEST_OPTIONS})
  capstan_compile_together(${TEST_NAME} 5)
  set_source_files_properties(${TEST_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(Qt5::Test IN_LIST TEST_LINKS)
    capstan_precompiled(${TEST_NAME} window_test)
  else()
    capstan_precompiled(${TEST_NAME} test)
  endif()
  if(TEST_WHOLE)
    add_test(NAME ${TEST_NAME} COMMAND ${TEST_NAME})
    set_tests_properties(${TEST_NAME} PROPERTIES TIMEOUT ${TEST_TIMEOUT})
  elseif(TEST_SUITES)
    set(suites ${CMAKE_CURRENT_BINARY_DIR}/${TEST_NAME}_suites)
    file(
      GENERATE
      OUTPUT ${suites}.cmake
      CONTENT
        "set(CAPSTAN_SUITES_NAME \"${TEST_NAME}\")
set(CAPSTAN_SUITES_PROGRAM \"$<TARGET_FILE:${TEST_NAME}>\")
set(CAPSTAN_SUITES_TIMEOUT ${TEST_TIMEOUT})
set(CAPSTAN_SUITES_LIST \"${suites}.txt\")
include(\"${PROJECT_SOURCE_DIR}/packaging/cmake/CapstanSuites.cmake\")
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites}.cmake)
  else()
    gtest_discover_tests(${TEST_NAME} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT ${TEST_TIMEOUT})
  endif()
endfunction()

# Builds every benchmark and study (packaging/prepare benchmarks); they are no part of the tests.
add_custom_target(benchmarks)

# A Google Benchmark executable; tests/benchmarks/run builds and runs them all.
function(capstan_benchmark)
  cmake_parse_arguments(BENCH "" "NAME" "SOURCES;LINKS" ${ARGN})
  add_executable(${BENCH_NAME} EXCLUDE_FROM_ALL ${BENCH_SOURCES})
  add_dependencies(benchmarks ${BENCH_NAME})
  target_link_libraries(${BENCH_NAME} PRIVATE ${BENCH_LINKS} capstan_test_folders capstan_options benchmark::benchmark)
endfunction()

# A command of its own that measures or counts. What it calls is optimised in full, itself not.
function(capstan_study)
  cmake_parse_arguments(STUDY "" "NAME" "SOURCES;LINKS" ${ARGN})
  add_executable(${STUDY_NAME} EXCLUDE_FROM_ALL ${STUDY_SOURCES})
  add_dependencies(benchmarks ${STUDY_NAME})
  target_link_libraries(${STUDY_NAME} PRIVATE ${STUDY_LINKS} CLI11::CLI11 nlohmann_json::nlohmann_json capstan_options)
  target_compile_options(${STUDY_NAME} PRIVATE ${CAPSTAN_TEST_OPTIONS})
  capstan_precompiled(${STUDY_NAME} command)
endfunction()
